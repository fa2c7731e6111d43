// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <nlohmann/json.hpp>

#include <pcl_als/report/inventory_report.h>

namespace pcl_als::detail {

/// Adds "trajectories" and, where there are some, "accuracies".
void addFlight(nlohmann::ordered_json& json, const ListedTrajectory& flight);

}  // namespace pcl_als::detail
