// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "ray_offset.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include <pcl_als/common/statistics.h>

#include "coordinate_cause.h"
#include "path_constants.h"

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

/// The trajectory at the time of a ray, from its lower return.
struct Seen {
  Eigen::Vector3d from, direction;
  double separation = 1.0, leverage = 1.0, residual = 0.0;

  void setDistance(double distance) {
    const double extended = std::max(2.0, distance / separation);
    leverage = extended * extended + (extended - 1.0) * (extended - 1.0);
  }
};

/// Returns without numbers, which only share a time, are no evidence against a trajectory.
std::vector<Seen> seenFrom(const PathEvidence& evidence, const Trajectory& flight,
                           RayOffset& found) {
  std::vector<Seen> rays;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  std::size_t cursor = 0;
  for (const auto& entry : evidence.bins()) {
    for (const PulseRay& ray : entry.second.rays) {
      PathSpan path;
      if (ray.by_time || !flight.pathAt(ray.time, path, cursor)) continue;
      Seen& seen = rays.emplace_back();
      seen.from = path.at(ray.time) - ray.lower;
      seen.separation = ray.separation();
      seen.direction = ray.span.cast<double>() / seen.separation;
      seen.setDistance(seen.from.norm());
      velocity += path.velocity;
      found.height += seen.from.z();
    }
  }
  if (rays.empty()) return rays;
  found.height /= static_cast<double>(rays.size());
  velocity /= static_cast<double>(rays.size());
  found.speed = velocity.head<2>().norm();
  found.course = velocity.head<2>().normalized();
  return rays;
}

/// Least absolute deviations of one vector for all rays.
class OffsetFit {
 public:
  explicit OffsetFit(std::vector<Seen> rays) : rays_(std::move(rays)) {}

  bool run() {
    for (int i = 0; i < kLineSteps; ++i) {
      if (!solve()) return false;
      residuals();
    }
    return scale_ < kLargestMiss;
  }
  const Eigen::Vector3d& offset() const { return offset_; }
  double stdAlong(const Eigen::Vector3d& unit) const {
    return scale_ * kSharing * std::sqrt(unit.dot(normal_.inverse() * unit));
  }

 private:
  bool solve() {
    normal_.setZero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Seen& ray : rays_) {
      const double weight = 1.0 / (ray.leverage * std::max(1.0, ray.residual / scale_));
      const Eigen::Matrix3d across =
          weight * (Eigen::Matrix3d::Identity() - ray.direction * ray.direction.transpose());
      normal_ += across;
      right -= across * ray.from;
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal_);
    if (solver.info() != Eigen::Success || !(solver.rcond() > kRegularLine)) return false;
    offset_ = solver.solve(right);
    return true;
  }
  void residuals() {
    std::vector<double> sizes;
    for (Seen& ray : rays_) {
      const Eigen::Vector3d to_path = ray.from + offset_;
      const double along = ray.direction.dot(to_path);
      ray.setDistance(along);
      ray.residual = (to_path - along * ray.direction).norm() / std::sqrt(ray.leverage);
      sizes.push_back(ray.residual);
    }
    scale_ = std::max(medianInPlace(sizes) / kNormMedian, kLeastAcross);
  }

  std::vector<Seen> rays_;
  double scale_ = 1.0;
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d normal_;
};

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
        Remedy::geoid};
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
  std::vector<Seen> rays = seenFrom(evidence, flight, found);
  if (rays.size() < kFewestRays) return std::nullopt;
  OffsetFit fit(std::move(rays));
  if (!fit.run()) return std::nullopt;
  found.offset = fit.offset();
  found.std = fit.stdAlong(found.offset.normalized());
  found.along = found.offset.head<2>().dot(found.course);
  return found;
}

}  // namespace pcl_als::detail
