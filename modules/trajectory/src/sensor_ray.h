// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include <pcl_als/trajectory/path_evidence.h>

namespace pcl_als::detail {

/// The ray of a pulse against a place of the sensor.
struct SensorRay {
  SensorRay(const PulseRay& ray, const Eigen::Vector3d& origin)
      : lower(ray.lower - origin),
        direction(ray.span.cast<double>() / ray.separation()),
        time(ray.time),
        separation(ray.separation()) {}

  Eigen::Vector3d lower, direction;  ///< metres, from the origin; unit vector, upwards
  double time;                       ///< seconds
  double separation;                 ///< metres, of its returns
  double distance = 1000.0;          ///< metres, from the lower return to the sensor
  double residual = 0.0;             ///< metres, distance of the sensor from the ray

  /// Variance at the sensor for a variance of one of either return across the ray.
  double leverage() const {
    const double extended = distance / separation;
    return extended * extended + (extended - 1.0) * (extended - 1.0);
  }
  /// Projection across the ray.
  Eigen::Matrix3d across() const {
    return Eigen::Matrix3d::Identity() - direction * direction.transpose();
  }
  /// Sets distance and residual. \return the residual as one of the returns, metres
  double compareWith(const Eigen::Vector3d& sensor) {
    const Eigen::Vector3d to_sensor = sensor - lower;
    const double along = direction.dot(to_sensor);
    distance = std::max(along, 1.001 * separation);
    residual = (to_sensor - along * direction).norm();
    return residual / std::sqrt(leverage());
  }
};

}  // namespace pcl_als::detail
