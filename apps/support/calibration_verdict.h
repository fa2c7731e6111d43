// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/visualization/html_report.h>

namespace pcl_als::app {

/// What a calibration comes to, in plain words.
struct CalibrationVerdict {
  VerdictGrade grade = VerdictGrade::attention;
  std::string headline;
  std::vector<std::string> sentences;
};

CalibrationVerdict verdictOf(const CalibrationResult& result);

}  // namespace pcl_als::app
