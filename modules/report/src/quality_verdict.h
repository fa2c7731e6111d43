// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/report/quality_report.h>

#include "report_parts.h"

namespace pcl_als {

Verdict verdictOf(const QualityReport& report);

}  // namespace pcl_als
