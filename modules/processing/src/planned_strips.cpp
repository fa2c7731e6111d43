// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/processing/planned_strips.h>

namespace pcl_als {

std::vector<StripGeometry> readPlannedStrips(const std::filesystem::path& path,
                                             const StripGeometry& common) {
  std::vector<StripGeometry> strips;
  for (const FlightLineRecord& record : readFlightLines(path)) {
    StripGeometry& planned = strips.emplace_back(common);
    planned.id = record.id;
    planned.start = record.start;
    planned.end = record.end;
    planned.height = record.height;
    planned.speed = record.speed.value_or(common.speed);
    planned.density = record.density.value_or(common.density);
    try {
      planned.validate();
    } catch (const UsageError& error) {  // a value of the file, not of the caller
      throw InputError(path.string() + ": " + error.what());
    }
  }
  return strips;
}

std::function<std::optional<SurfacePoint>(const Eigen::Vector2d&)> terrainOf(
    const std::shared_ptr<const ElevationGrid>& grid) {
  return [grid](const Eigen::Vector2d& place) -> std::optional<SurfacePoint> {
    Eigen::Vector2d gradient;
    const std::optional<double> z = grid->at(place, gradient);
    if (!z) return std::nullopt;
    return SurfacePoint{*z - grid->mean(),
                        Eigen::Vector3d(-gradient.x(), -gradient.y(), 1.0).normalized()};
  };
}

}  // namespace pcl_als
