// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <string_view>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als::detail {

class JsonNode;

inline constexpr std::string_view kCalibrationFormat = "pcl_als calibration";
/// Version 1 had no parts: all keys were those of one object.
inline constexpr int kCalibrationVersion = 2;

/// The text of a calibration.json. UsageError for a bias that is not finite; any other number that
/// is not becomes null.
std::string calibrationToJson(const CalibrationResult& result);

/// Reads it back; \a name is the file, for messages.
CalibrationResult calibrationFromJson(const std::string& text, const std::string& name);

/// Reads the instrument part of a calibration.json or of another file that has one.
CalibrationResult instrumentIn(const JsonNode& part);

}  // namespace pcl_als::detail
