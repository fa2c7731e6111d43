// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <nlohmann/json.hpp>

#include <pcl_als/common/calibration_result.h>

#include "json_node.h"

namespace pcl_als::detail {

/// The errors of the strips, "strip_corrections".
nlohmann::ordered_json stripErrorsOf(const CalibrationResult& result);
/// Reads them from the part that has them; also of files without standard deviations.
void readStripErrors(const JsonNode& part, CalibrationResult& result);

/// Adds "error_levels", the standard deviations of errors that are not estimated, where they are
/// known.
void writeErrorLevels(const CalibrationResult& result, nlohmann::ordered_json& part);
void readErrorLevels(const JsonNode& part, CalibrationResult& result);

}  // namespace pcl_als::detail
