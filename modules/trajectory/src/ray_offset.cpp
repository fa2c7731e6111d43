// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "ray_offset.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "coordinate_cause.h"
#include "ray_fit.h"

namespace pcl_als::detail {
namespace {

constexpr std::size_t kFewestRays = 30;
constexpr double kSignificantOffset = 5.0;  // standard deviations
// Rays of neighbouring times share the errors of the attitude: as if they were so many fewer.
constexpr double kSharing = 4.0;
constexpr double kLeastOffset = 3.0;  // metres: lever arms of aircraft are shorter

// Rays that miss a common place by more, in metres at their returns, are of other pulses or of
// returns that were not separated.
constexpr double kLargestMiss = 0.1;

/// Returns without numbers, which only share a time, are no evidence against a trajectory.
/// Rays whose origin is the trajectory at their time.
std::vector<SensorRay> seenFrom(const PathEvidence& evidence, const Trajectory& flight,
                                RayOffset& found) {
  std::vector<SensorRay> rays;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  std::size_t cursor = 0;
  for (const auto& entry : evidence.bins()) {
    for (const PulseRay& ray : entry.second.rays) {
      PathSpan path;
      if (ray.by_time || !flight.pathAt(ray.time, path, cursor)) continue;
      rays.emplace_back(ray, path.at(ray.time));
      velocity += path.velocity;
      found.height -= rays.back().lower.z();
    }
  }
  if (rays.empty()) return rays;
  found.height /= static_cast<double>(rays.size());
  velocity /= static_cast<double>(rays.size());
  found.speed = velocity.head<2>().norm();
  found.course = velocity.head<2>().normalized();
  return rays;
}

}  // namespace

bool RayOffset::exceeds(double share) const {
  const double size = offset.norm();
  return size > kSignificantOffset * std && size > std::max(kLeastOffset, share * height);
}

Warning RayOffset::cause() const {
  constexpr double kMostly = 0.1;  // of the offset, across its main direction
  const double size = offset.norm(), up = std::abs(offset.z());
  if (offset.head<2>().norm() < kMostly * up && up > kLeastUndulation && up < kLargestUndulation)
    return {
        "an offset as between ellipsoidal heights and heights above a geoid, whose undulation "
        "can be given",
        Hint::geoid};
  if (size * size - along * along > kMostly * size * size) return "";
  const double seconds = along / speed;
  const Warning utc = timeCause(seconds);
  if (!utc.text.empty()) return utc;
  char text[80];
  std::snprintf(text, sizeof text, "%.2f s of flight, as if two clocks differed by this",
                std::abs(seconds));
  return text;
}

std::optional<RayOffset> rayOffset(const PathEvidence& evidence, const Trajectory& flight) {
  RayOffset found;
  std::vector<SensorRay> rays = seenFrom(evidence, flight, found);
  if (rays.size() < kFewestRays) return std::nullopt;
  const std::optional<RayFit> fit = fitRays(rays, false);
  if (!fit || fit->scale >= kLargestMiss) return std::nullopt;
  found.offset = fit->unknowns;
  const Eigen::Vector3d unit = found.offset.normalized();
  found.std = fit->scale * kSharing * std::sqrt(unit.dot(fit->cofactor * unit));
  found.along = found.offset.head<2>().dot(found.course);
  return found;
}

}  // namespace pcl_als::detail
