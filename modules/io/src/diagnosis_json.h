// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als::detail {

class JsonNode;

/// Adds "error_sources" (the values that are corrected) and "diagnosis" to a calibration.json.
void writeDiagnosis(const CalibrationResult& result, nlohmann::ordered_json& root);
/// Reads both where they are present.
void readDiagnosis(const JsonNode& root, CalibrationResult& result);

}  // namespace pcl_als::detail
