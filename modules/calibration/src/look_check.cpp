// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/calibration/look_check.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {

void LookCheck::add(const CalibrationPoint& point) {
  // Half of the widest field of view of airborne scanners, and of the widest forward looks (the
  // fore and aft planes of a multi-look scanner, the skew of a slanted mirror) with attitude motion
  // on top.
  constexpr double kWidest = 75.0 * kRadiansPerDegree, kFarthestAhead = 35.0 * kRadiansPerDegree;
  SensorPose pose;
  if (!trajectory_->poseAt(point.time, pose, cursor_)) return;
  ++count_;
  const Eigen::Vector3d d = point.position - pose.position;
  if (d.z() >= 0.0) {
    ++above_;
    return;
  }
  const ScanGeometry geometry = scanGeometry(pose, point.position);
  const double lateral = pose.rotation.col(0).head<2>().normalized().dot(d.head<2>());
  const double along = pose.rotation.col(1).head<2>().normalized().dot(d.head<2>());
  if (std::abs(geometry.beta) > kWidest) {
    ++beside_;
    beside_sum_ += std::abs(lateral);
  }
  // From the height, not the range: the edge of a wide swath is far, and not ahead.
  if (std::abs(along) > std::tan(kFarthestAhead) * std::hypot(d.z(), lateral)) {
    ++ahead_;
    ahead_sum_ += std::abs(along);
  }
}

std::string LookCheck::objection() const {
  const auto most = [this](std::size_t some) { return 2 * some > count_; };
  const auto metres = [](double sum, std::size_t some) {
    return std::to_string(std::lround(sum / static_cast<double>(some))) + " m";
  };
  if (most(above_)) return "its points lie above the trajectory";
  if (most(beside_))
    return "its points lie " + metres(beside_sum_, beside_) + " beside the trajectory";
  if (most(ahead_))
    return "its points lie " + metres(ahead_sum_, ahead_) +
           " ahead of or behind where they were fired";
  return {};
}

}  // namespace pcl_als
