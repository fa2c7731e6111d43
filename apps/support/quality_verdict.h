// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "quality_report.h"
#include "report_parts.h"

namespace pcl_als::app {

Verdict verdictOf(const QualityReport& report);

}  // namespace pcl_als::app
