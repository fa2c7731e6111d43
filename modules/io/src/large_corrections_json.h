// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <nlohmann/json.hpp>

#include <pcl_als/common/calibration_result.h>

#include "json_node.h"

namespace pcl_als::detail {

/// The largest corrections of the trajectory, "large_corrections"; empty where there are none.
nlohmann::ordered_json largeCorrectionsOf(const CalibrationResult& result);
/// Reads them from the part that has them; files of earlier versions have none.
void readLargeCorrections(const JsonNode& part, CalibrationResult& result);

}  // namespace pcl_als::detail
