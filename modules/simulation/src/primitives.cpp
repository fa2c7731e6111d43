// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <Eigen/Geometry>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/primitives.h>

namespace pcl_als::simulation {

Polygon::Polygon(const std::vector<Eigen::Vector3d>& corners) {
  sides_ = static_cast<int>(corners.size());
  if (sides_ < 3 || sides_ > 5) throw UsageError("a polygon of the scene has 3 to 5 corners");
  normal_ = Eigen::Vector3d::Zero();
  minimum_ = maximum_ = corners.front();
  for (int i = 0; i < sides_; ++i) {
    const Eigen::Vector3d& next = corners[(i + 1) % sides_];
    normal_ += (corners[i] - corners[0]).cross(next - corners[0]);
    minimum_ = minimum_.cwiseMin(corners[i]);
    maximum_ = maximum_.cwiseMax(corners[i]);
  }
  normal_.normalize();
  for (int i = 0; i < sides_; ++i) {
    inward_[i] = normal_.cross(corners[(i + 1) % sides_] - corners[i]);
    side_offset_[i] = inward_[i].dot(corners[i]);
  }
  if (normal_.z() < 0.0) normal_ = -normal_;
  offset_ = normal_.dot(corners[0]);
}

std::optional<double> Polygon::intersect(const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction) const {
  const double along = normal_.dot(direction);
  if (along == 0.0) return std::nullopt;
  const double range = (offset_ - normal_.dot(origin)) / along;
  if (!(range > 0.0)) return std::nullopt;
  const Eigen::Vector3d point = origin + range * direction;
  for (int i = 0; i < sides_; ++i)
    if (inward_[i].dot(point) < side_offset_[i]) return std::nullopt;
  return range;
}

std::optional<double> Ball::intersect(const Eigen::Vector3d& origin,
                                      const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d to_centre = centre - origin;
  const double closest = to_centre.dot(direction);
  const double miss_sq = (to_centre - closest * direction).squaredNorm();
  const double half_chord_sq = radius * radius - miss_sq;
  if (half_chord_sq < 0.0) return std::nullopt;
  const double range = closest - std::sqrt(half_chord_sq);
  if (!(range > 0.0)) return std::nullopt;
  return range;
}

std::optional<double> Disc::intersect(const Eigen::Vector3d& origin,
                                      const Eigen::Vector3d& direction) const {
  if (direction.z() == 0.0) return std::nullopt;
  const double range = (centre.z() - origin.z()) / direction.z();
  if (!(range > 0.0)) return std::nullopt;
  const Eigen::Vector2d from = (origin + range * direction - centre).head<2>();
  if (from.squaredNorm() > radius * radius) return std::nullopt;
  return range;
}

}  // namespace pcl_als::simulation
