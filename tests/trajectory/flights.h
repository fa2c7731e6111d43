// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <vector>

#include <pcl_als/common/survey_types.h>

namespace pcl_als::test {

/// Samples of a path given as a function of time, \a step seconds apart, both ends included.
template <typename Path>
std::vector<TrajectorySample> sampled(const Path& path, double from, double to, double step) {
  std::vector<TrajectorySample> samples;
  const int count = static_cast<int>(std::lround((to - from) / step)) + 1;
  for (int i = 0; i < count; ++i) {
    TrajectorySample sample;
    sample.time = from + i * step;
    sample.position = path(sample.time);
    samples.push_back(sample);
  }
  return samples;
}

/// 60 m/s along a course in degrees clockwise from north, at 1000 m, through the origin at time 0.
inline auto straight(double course, const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  const double angle = course * std::acos(-1.0) / 180.0;
  const Eigen::Vector3d velocity(60.0 * std::sin(angle), 60.0 * std::cos(angle), 0.0);
  return [=](double time) -> Eigen::Vector3d {
    return shift + Eigen::Vector3d(0.0, 0.0, 1000.0) + time * velocity;
  };
}

/// 60 m/s on a circle of 3 km to the right, heading north at time 0.
inline Eigen::Vector3d circling(double time) {
  const double turned = 60.0 / 3000.0 * time;
  return {3000.0 * (1.0 - std::cos(turned)), 3000.0 * std::sin(turned), 1000.0};
}

}  // namespace pcl_als::test
