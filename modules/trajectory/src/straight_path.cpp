// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "straight_path.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include <pcl_als/common/statistics.h>

#include "path_constants.h"

namespace pcl_als::detail {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A ray relative to the middle of the rays.
struct Ray {
  double time = 0.0, separation = 0.0, distance = 1000.0;
  Eigen::Vector3d lower, direction;
  double residual = 0.0;  ///< over the standard deviation for returns of 1 m across the ray

  double leverage() const {
    const double extended = distance / separation;
    return extended * extended + (extended - 1.0) * (extended - 1.0);
  }
};

class LineFit {
 public:
  LineFit(const PathEvidence& evidence, const TimeRange& span) : origin_(evidence.origin()) {
    for (const auto& entry : evidence.bins()) {
      for (const PulseRay& ray : entry.second.rays) {
        if (ray.time < span.first || ray.time > span.last) continue;
        Ray& taken = rays_.emplace_back();
        taken.time = ray.time;
        taken.separation = ray.separation();
        taken.lower = ray.lower - origin_;
        taken.direction = ray.span.cast<double>() / taken.separation;
        middle_ += ray.time;
      }
    }
    if (!rays_.empty()) middle_ /= static_cast<double>(rays_.size());
  }

  std::optional<StraightPath> run() {
    if (rays_.size() < kFewestRaysOfLine) return std::nullopt;
    for (int i = 0; i < kLineSteps; ++i) {
      if (!solve()) return std::nullopt;
      residuals();
    }
    return result();
  }

 private:
  bool solve() {
    normal_.setZero();
    Vector6 right = Vector6::Zero();
    for (const Ray& ray : rays_) {
      const double weight = 1.0 / (ray.leverage() * std::max(1.0, ray.residual / scale_));
      const Eigen::Matrix3d across =
          weight * (Eigen::Matrix3d::Identity() - ray.direction * ray.direction.transpose());
      const double t = ray.time - middle_;
      normal_.topLeftCorner<3, 3>() += across;
      normal_.topRightCorner<3, 3>() += t * across;
      normal_.bottomRightCorner<3, 3>() += t * t * across;
      right.head<3>() += across * ray.lower;
      right.tail<3>() += t * (across * ray.lower);
    }
    normal_.bottomLeftCorner<3, 3>() = normal_.topRightCorner<3, 3>().transpose();
    const Eigen::LDLT<Matrix6> solver(normal_);
    if (solver.info() != Eigen::Success || !(solver.rcond() > kRegularLine)) return false;
    line_ = solver.solve(right);
    return line_.allFinite();
  }

  void residuals() {
    std::vector<double> sizes;
    for (Ray& ray : rays_) {
      const Eigen::Vector3d to_line =
          line_.head<3>() + (ray.time - middle_) * line_.tail<3>() - ray.lower;
      const double along = ray.direction.dot(to_line);
      ray.distance = std::max(along, 1.001 * ray.separation);
      ray.residual = (to_line - along * ray.direction).norm() / std::sqrt(ray.leverage());
      sizes.push_back(ray.residual);
    }
    scale_ = std::max(medianInPlace(sizes) / kNormMedian, kLeastAcross);
  }

  StraightPath result() const {
    StraightPath line;
    line.time = middle_;
    line.position = origin_ + line_.head<3>();
    line.velocity = line_.tail<3>();
    line.covariance = scale_ * scale_ * normal_.inverse();
    line.rays = rays_.size();
    const double across = std::clamp(scale_, kAcross, 10.0 * kAcross);
    for (const Ray& ray : rays_) {
      line.height += ray.direction.z() * ray.distance;
      line.fitting += ray.residual < kNormRejection * across ? 1.0 : 0.0;
    }
    line.height /= static_cast<double>(rays_.size());
    line.fitting /= static_cast<double>(rays_.size());
    return line;
  }

  Eigen::Vector3d origin_;
  std::vector<Ray> rays_;
  double middle_ = 0.0, scale_ = kAcross;
  Matrix6 normal_;
  Vector6 line_;
};

}  // namespace

PathSample StraightPath::at(double at_time) const {
  const double t = at_time - time;
  PathSample sample;
  sample.time = at_time;
  sample.position = position + t * velocity;
  sample.velocity = velocity;
  const double bend = 0.5 * kBend * t * t;
  sample.covariance =
      covariance.topLeftCorner<3, 3>() +
      t * (covariance.topRightCorner<3, 3>() + covariance.bottomLeftCorner<3, 3>()) +
      t * t * covariance.bottomRightCorner<3, 3>() +
      (bend * bend + kRough * kRough) * Eigen::Matrix3d::Identity();
  sample.velocity_covariance =
      covariance.bottomRightCorner<3, 3>() + (kBend * kBend * t * t) * Eigen::Matrix3d::Identity();
  return sample;
}

std::optional<StraightPath> straightPath(const PathEvidence& evidence, const TimeRange& span) {
  return LineFit(evidence, span).run();
}

}  // namespace pcl_als::detail
