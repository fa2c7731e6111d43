// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als::detail {

class JsonNode;

/// Adds "error_sources", the values that are corrected, to a part of a calibration.json.
void writeErrorSources(const CalibrationResult& result, nlohmann::ordered_json& part);
void readErrorSources(const JsonNode& part, CalibrationResult& result);

/// Adds "diagnosis" and "scan_angle_curve", where there are any.
void writeDiagnosis(const CalibrationResult& result, nlohmann::ordered_json& part);
void readDiagnosis(const JsonNode& part, CalibrationResult& result);

}  // namespace pcl_als::detail
