// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <pcl_als/calibration/flight_plan.h>
#include <pcl_als/io/plan_io.h>

namespace pcl_als {

/// The lines of a flight plan (readFlightLines()) as strips for FlightPlan; what the file does not
/// state is taken from \a common. InputError also for a line with an impossible value.
std::vector<StripGeometry> readPlannedStrips(const std::filesystem::path& path,
                                             const StripGeometry& common);

/// SurfaceModel::terrain of a grid of elevations: heights refer to the mean of the grid.
std::function<std::optional<SurfacePoint>(const Eigen::Vector2d&)> terrainOf(
    const std::shared_ptr<const ElevationGrid>& grid);

/// The share of the swaths of the lines that has an elevation. InputError with the
/// distance where there is none: the grid, read from \a path, is that of another area, or in
/// another frame.
double terrainCoverage(const std::vector<StripGeometry>& lines, const ElevationGrid& grid,
                       const std::filesystem::path& path);

}  // namespace pcl_als
