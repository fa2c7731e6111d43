// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/report/intensity_report.h>

#include "report_parts.h"

namespace pcl_als {

/// \a reliable: whether all that was asked for could be estimated.
Verdict verdictOf(const IntensityReport& report);

}  // namespace pcl_als
