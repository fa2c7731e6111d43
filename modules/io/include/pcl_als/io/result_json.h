// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/// The text of a calibration.json, as writeCalibration() writes it. UsageError for a bias that is
/// not finite.
std::string calibrationJson(const CalibrationResult& result);

/// Reads such a text back, as readCalibration() does. InputError names \a name and what is wrong.
CalibrationResult parseCalibration(const std::string& text, const std::string& name);

}  // namespace pcl_als
