// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als::detail {

class JsonNode;

/// Adds "prior" (with its differences to the flight) and "held" to the instrument part of a
/// calibration.json, where there are any; interface units (m, arcsec, 1).
void writePrior(const CalibrationResult& result, nlohmann::ordered_json& part);
void readPrior(const JsonNode& part, CalibrationResult& result);

/// The parameters that a list names. InputError for a name that is none.
std::vector<SystemParameter> parametersNamed(const JsonNode& names);

}  // namespace pcl_als::detail
