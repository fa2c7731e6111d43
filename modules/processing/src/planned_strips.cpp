// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>
#include <limits>

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

double terrainCoverage(const std::vector<StripGeometry>& lines, const ElevationGrid& grid,
                       const std::filesystem::path& path) {
  constexpr int kAlong = 100;                                // places on each line
  constexpr double kAcross[] = {-0.8, -0.4, 0.0, 0.4, 0.8};  // of half the swath
  const Eigen::AlignedBox2d extent = grid.extent();
  double all = 0.0, covered = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (const StripGeometry& line : lines) {
    const Eigen::Vector2d along = line.direction(), right(along.y(), -along.x());
    for (int i = 0; i < kAlong; ++i)
      for (const double across : kAcross) {
        const Eigen::Vector2d place = line.start + (i + 0.5) / kAlong * line.length() * along +
                                      across * line.halfSwath() * right;
        Eigen::Vector2d gradient;
        all += line.length();
        if (grid.at(place, gradient)) covered += line.length();
        nearest = std::min(nearest, extent.exteriorDistance(place));
      }
  }
  if (covered > 0.0) return covered / all;
  char distance[64] = "";
  if (nearest > 0.0)
    std::snprintf(distance, sizeof distance, " (its nearest cell is %.1f km away)", 1e-3 * nearest);
  throw InputError(path.string() + ": has no elevation below any of the lines" + distance +
                   "; give elevations of the planned area, in the frame of the lines");
}

}  // namespace pcl_als
