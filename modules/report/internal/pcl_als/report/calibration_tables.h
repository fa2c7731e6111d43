// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// Writes pairs.csv, iterations.csv and areas.csv into a folder. \a information: share of each area
/// in the information about the parameters, sum 1.
void writeCalibrationCsv(const std::filesystem::path& folder, const CalibrationResult& result,
                         const std::vector<SurveyArea>& areas,
                         const std::vector<double>& information);

}  // namespace pcl_als
