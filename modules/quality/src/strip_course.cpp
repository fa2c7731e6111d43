// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <Eigen/LU>

#include <pcl_als/quality/strip_course.h>

namespace pcl_als {
namespace {

constexpr double kLeastTimeSpread = 1e-3;  // seconds, standard deviation
constexpr double kLeastAngleSpread = 0.1;  // degrees
// correlation of time and angle above which they cannot be separated
constexpr double kMostCorrelated = 0.999;
constexpr double kLeastSpeed = 1.0;  // metres per second

}  // namespace

void StripCourse::add(const LidarReturn& point) {
  if (count_++ == 0) {
    reference_ = point.position.head<2>();
    time_reference_ = point.time;
  }
  const Eigen::Vector3d row(1.0, point.time - time_reference_, point.scan_angle);
  normal_ += row * row.transpose();
  right_ += row * (point.position.head<2>() - reference_).transpose();
}

std::optional<Eigen::Vector2d> StripCourse::direction() const {
  if (count_ < 3) return std::nullopt;
  const double n = static_cast<double>(count_);
  // About the means, so that time and angle are two unknowns only.
  const Eigen::Vector2d mean = normal_.col(0).tail<2>() / n;
  const Eigen::Matrix2d spread = normal_.bottomRightCorner<2, 2>() / n - mean * mean.transpose();
  const Eigen::Matrix2d with =
      right_.bottomRows<2>() / n - mean * (right_.row(0) / n);  // rows: time, angle; columns: x, y
  if (!(spread(0, 0) > kLeastTimeSpread * kLeastTimeSpread)) return std::nullopt;
  const double correlation = spread(0, 1) / std::sqrt(spread(0, 0) * std::max(spread(1, 1), 1e-12));
  const bool angles = spread(1, 1) > kLeastAngleSpread * kLeastAngleSpread &&
                      std::abs(correlation) < kMostCorrelated;
  const Eigen::Vector2d velocity =
      angles ? Eigen::Vector2d((spread.inverse() * with).row(0).transpose())
             : Eigen::Vector2d(with.row(0).transpose() / spread(0, 0));
  if (!(velocity.norm() > kLeastSpeed)) return std::nullopt;
  return velocity.normalized();
}

}  // namespace pcl_als
