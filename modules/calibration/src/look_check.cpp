// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <Eigen/Eigenvalues>

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
  const Eigen::Vector2d direction = pose.rotation.col(1).head<2>().normalized();
  direction_sum_ += direction;
  mean_ahead_sum_ += pose.rotation.col(1).dot(d);
  height_sum_ -= d.z();
  const double lateral = pose.rotation.col(0).head<2>().normalized().dot(d.head<2>());
  const double along = direction.dot(d.head<2>());
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

LookCheck::Look LookCheck::look() const {
  Look look;
  const auto below = static_cast<double>(count_ - above_);
  if (below == 0.0 || direction_sum_.norm() < 0.5 * below) return look;
  look.seen = true;
  look.direction = direction_sum_.normalized();
  look.ahead = mean_ahead_sum_ / below;
  look.height = height_sum_ / below;
  return look;
}

Eigen::Vector2d trajectoryOffset(const std::vector<LookCheck::Look>& looks, bool attitude_known) {
  const double doubt = std::tan((attitude_known ? 1.0 : 5.0) * kRadiansPerDegree);
  double hh = 0.0, ha = 0.0, highest = 0.0;
  Eigen::Vector2d hd = Eigen::Vector2d::Zero(), da = hd;
  Eigen::Matrix2d dd = Eigen::Matrix2d::Zero();
  for (const LookCheck::Look& look : looks) {
    if (!look.seen) continue;
    hh += look.height * look.height, ha += look.height * look.ahead;
    hd += look.height * look.direction, da += look.ahead * look.direction;
    dd += look.direction * look.direction.transpose();
    highest = std::max(highest, look.height);
  }
  if (hh == 0.0) return Eigen::Vector2d::Zero();
  // The forward look c eliminated; then each axis that enough strips see from both sides.
  constexpr double kSeen = 0.3;  // two strips at a right angle: 1; a turn of 30 degrees: 0.13
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(dd - hd * hd.transpose() / hh);
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d axis = axes.eigenvectors().col(i);
    if (axes.eigenvalues()[i] < kSeen) continue;
    offset -= axis * (axis.dot(da - hd * ha / hh) / axes.eigenvalues()[i]);
  }
  return offset.norm() > doubt * highest ? offset : Eigen::Vector2d(Eigen::Vector2d::Zero());
}

}  // namespace pcl_als
