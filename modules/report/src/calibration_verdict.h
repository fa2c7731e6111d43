// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/calibration_result.h>

#include "report_parts.h"

namespace pcl_als {

/// "Lever arm x"
std::string headingOf(SystemParameter parameter);

Verdict verdictOf(const CalibrationResult& result);

}  // namespace pcl_als
