// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/calibration/flight_plan.h>

namespace pcl_als {

class FieldTable;

/// The expected results of a plan, as tables for a terminal.
std::string planTables(const FlightPlanResult& result);

/// The same as plan.json, and its description.
std::string planJson(const FlightPlanResult& result, const std::vector<std::string>& inputs);
const FieldTable& planFields();

/// The parameters that a planned flight will not determine, with the reasons; empty: none.
std::string notDetermined(const CalibrationResult& expected);

}  // namespace pcl_als
