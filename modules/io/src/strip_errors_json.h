// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <nlohmann/json.hpp>

#include <pcl_als/common/calibration_result.h>

#include "json_node.h"

namespace pcl_als::detail {

/// Writes the errors of the strips ("strip_corrections") and, where they are known, the standard
/// deviations of errors that are not estimated ("error_levels").
void writeStripErrors(const CalibrationResult& result, nlohmann::ordered_json& root);

/// Reads what writeStripErrors() wrote; also files without standard deviations.
void readStripErrors(const JsonNode& root, CalibrationResult& result);

}  // namespace pcl_als::detail
