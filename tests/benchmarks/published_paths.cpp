// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "published_paths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <pcl_als/adjustment/cubic_spline.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als::benchmark {
namespace {

constexpr double kThinning = 1e-3;  // seconds

struct Ray {
  double time = 0.0, separation = 0.0;
  Eigen::Vector3d last, direction;  ///< metres; unit vector, upwards
};

/// First and last returns of pulses, one pulse per millisecond.
std::vector<Ray> raysOf(const std::vector<LidarReturn>& points, double least_separation) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const LidarReturn& first = points[i];
    if (first.return_number != 1 || first.number_of_returns < 2) continue;
    const std::size_t k = i + first.number_of_returns - 1;
    if (k >= points.size() || points[k].time != first.time || !points[k].isLast()) continue;
    const Eigen::Vector3d span = first.position - points[k].position;
    if (span.norm() < least_separation) continue;
    if (!rays.empty() &&
        std::floor(first.time / kThinning) == std::floor(rays.back().time / kThinning))
      continue;
    rays.push_back({first.time, span.norm(), points[k].position, span.normalized()});
  }
  return rays;
}

}  // namespace

std::vector<TrajectorySample> intersectionOfRays(const std::vector<LidarReturn>& points) {
  constexpr double kInterval = 0.5;
  constexpr std::size_t kFewest = 50;
  const std::vector<Ray> rays = raysOf(points, 0.01);
  std::vector<TrajectorySample> path;
  for (std::size_t i = 0; i < rays.size();) {
    const double bin = std::floor(rays[i].time / kInterval);
    const std::size_t begin = i;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (; i < rays.size() && std::floor(rays[i].time / kInterval) == bin; ++i) {
      const Ray& ray = rays[i];
      const Eigen::Matrix3d across =
          Eigen::Matrix3d::Identity() - ray.direction * ray.direction.transpose();
      normal += ray.separation * across;
      right += ray.separation * across * (ray.last - rays[begin].last);
    }
    if (i - begin < kFewest) continue;
    TrajectorySample& sample = path.emplace_back();
    sample.time = (bin + 0.5) * kInterval;
    sample.position = rays[begin].last + normal.ldlt().solve(right);
  }
  return path;
}

namespace {

/// The spline adjustment: coefficients of the three coordinates one after the other.
class SplineAdjustment {
 public:
  SplineAdjustment(const std::vector<LidarReturn>& points, std::vector<Ray> rays)
      : rays_(std::move(rays)),
        origin_(points.front().position),
        spline_(points.front().time, points.back().time, 1.0),
        coefficients_(Eigen::VectorXd::Zero(3 * spline_.count())) {
    double last = -1.0;
    for (const LidarReturn& point : points) {
      if (!point.isLast() || !std::isfinite(point.scan_angle) || point.scan_angle == 0.0F) continue;
      if (std::floor(point.time / kThinning) == last) continue;
      last = std::floor(point.time / kThinning);
      singles_.push_back(&point);
    }
  }

  void solve() {
    for (int iteration = 0; iteration < 20; ++iteration) step(iteration > 0);
  }

  Eigen::Vector3d at(double time, bool slope = false) const {
    const UniformCubicSpline::Weights w = spline_.at(time);
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 3; ++c)
        value[c] += (slope ? w.slope : w.value)[static_cast<std::size_t>(k)] *
                    coefficients_[index(w.first + k, c)];
    return value;
  }
  Eigen::Vector3d position(double time) const { return origin_ + at(time); }

 private:
  int index(int knot, int c) const { return 3 * knot + c; }

  void add(const UniformCubicSpline::Weights& w, const Eigen::Vector3d& row, double value,
           double weight) {
    for (int a = 0; a < 4; ++a) {
      for (int i = 0; i < 3; ++i) {
        const double left = weight * w.value[static_cast<std::size_t>(a)] * row[i];
        right_[index(w.first + a, i)] += left * value;
        for (int b = 0; b < 4; ++b)
          for (int j = 0; j < 3; ++j)
            normal_(index(w.first + a, i), index(w.first + b, j)) +=
                left * w.value[static_cast<std::size_t>(b)] * row[j];
      }
    }
  }

  /// Angles between the ray and the direction to the sensor; Cauchy's loss.
  void addRays(bool robust) {
    constexpr double kNoise = 0.02;  // metres, of a return
    for (const Ray& ray : rays_) {
      const Eigen::Vector3d last = ray.last - origin_;
      double distance = 1000.0, weight = 1.0;
      const UniformCubicSpline::Weights w = spline_.at(ray.time);
      if (robust) {
        const Eigen::Vector3d to = at(ray.time) - last;
        distance = std::max(to.norm(), 10.0);
        const double miss = (to - to.dot(ray.direction) * ray.direction).norm() / distance;
        const double normalised = miss * ray.separation / kNoise;
        weight = 1.0 / (1.0 + normalised * normalised);
      }
      const double sigma = kNoise / ray.separation * distance;
      const Eigen::Vector3d a = ray.direction.cross(Eigen::Vector3d::UnitX()).normalized();
      for (const Eigen::Vector3d& e : {a, Eigen::Vector3d(ray.direction.cross(a))})
        add(w, e, e.dot(last), weight / (sigma * sigma));
    }
  }

  /// Lateral distance over height is the tangent of the recorded angle, positive to the right.
  void addAngles() {
    constexpr double kNoise = 1.0 * kRadiansPerDegree;
    for (const LidarReturn* point : singles_) {
      const Eigen::Vector2d velocity = at(point->time, true).head<2>();
      if (velocity.norm() < 1.0) continue;
      const Eigen::Vector2d course = velocity.normalized();
      const Eigen::Vector3d place = point->position - origin_;
      const double tangent = std::tan(static_cast<double>(point->scan_angle) * kRadiansPerDegree);
      const double height = std::max(10.0, at(point->time).z() - place.z());
      const double sigma = kNoise * height * (1.0 + tangent * tangent);
      const Eigen::Vector3d row(course.y(), -course.x(), tangent);
      const double miss = (row.dot(place) - row.dot(at(point->time))) / sigma;
      add(spline_.at(point->time), row, row.dot(place),
          1.0 / (1.0 + miss * miss) / (sigma * sigma));
    }
  }

  /// Accelerations of about 1 m/s^2 keep the spline regular.
  void addAccelerations() {
    const double step = spline_.step() * spline_.step();
    for (int knot = 0; knot + 2 < spline_.count(); ++knot)
      for (int c = 0; c < 3; ++c)
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b)
            normal_(index(knot + a, c), index(knot + b, c)) +=
                (a == 1 ? -2.0 : 1.0) * (b == 1 ? -2.0 : 1.0) / (step * step);
  }

  void step(bool robust) {
    normal_ = 1e-9 * Eigen::MatrixXd::Identity(coefficients_.size(), coefficients_.size());
    right_ = Eigen::VectorXd::Zero(coefficients_.size());
    addRays(robust);
    if (robust) addAngles();
    addAccelerations();
    coefficients_ = normal_.ldlt().solve(right_);
  }

  std::vector<Ray> rays_;
  std::vector<const LidarReturn*> singles_;
  Eigen::Vector3d origin_;
  UniformCubicSpline spline_;
  Eigen::VectorXd coefficients_, right_;
  Eigen::MatrixXd normal_;
};

}  // namespace

std::vector<TrajectorySample> splineOfRaysAndAngles(const std::vector<LidarReturn>& points,
                                                    double step) {
  std::vector<TrajectorySample> path;
  if (points.size() < 2) return path;
  SplineAdjustment adjustment(points, raysOf(points, 0.01));
  adjustment.solve();
  const auto first = static_cast<std::int64_t>(std::ceil(points.front().time / step));
  const auto last = static_cast<std::int64_t>(std::floor(points.back().time / step));
  for (std::int64_t i = first; i <= last; ++i) {
    TrajectorySample& sample = path.emplace_back();
    sample.time = static_cast<double>(i) * step;
    sample.position = adjustment.position(sample.time);
  }
  return path;
}

}  // namespace pcl_als::benchmark
