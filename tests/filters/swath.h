// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/scan_geometry.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als::test {

/// Of the swaths of these tests, metres.
inline const Eigen::Vector3d kOrigin(583390.0, 5283100.0, 500.0);

/// A position at a time, east-north-up.
struct SwathPoint {
  double time;
  Eigen::Vector3d ground;
};

/// Flown north at 60 m/s and 1000 m above \a origin, swaying 20 m, 100 Hz.
inline std::shared_ptr<const Trajectory> flownNorth(const Eigen::Vector3d& origin, double seconds) {
  std::vector<TrajectorySample> samples;
  for (int i = 0; i <= static_cast<int>(100.0 * seconds); ++i) {
    TrajectorySample sample;
    sample.time = 0.01 * i;
    sample.position =
        origin + Eigen::Vector3d(20.0 * std::sin(0.1 * sample.time), 60.0 * sample.time, 1000.0);
    samples.push_back(sample);
  }
  return std::make_shared<Trajectory>(samples);
}

/// Points under that flight, in order of time, up to 450 m to either side, some hills.
inline std::vector<SwathPoint> swath(const Eigen::Vector3d& origin, double seconds, int count) {
  std::vector<SwathPoint> points;
  for (int i = 0; i < count; ++i) {
    const double time = seconds * i / count;
    const double across = 450.0 * std::sin(0.7 * i);
    points.push_back(
        {time, origin + Eigen::Vector3d(across, 60.0 * time, 30.0 * std::sin(0.01 * across))});
  }
  return points;
}

/// Typical errors: 5 cm, 30 to 90 arcsec, 12 cm, 1e-4.
inline SystemVector typicalBiases() {
  SystemVector biases;
  biases << 0.05, -0.03, 0.0, 30.0 * kRadiansPerArcsec, 90.0 * kRadiansPerArcsec,
      -40.0 * kRadiansPerArcsec, -0.12, 1e-4;
  return biases;
}

/// What the biases did to a point, all in double.
inline Eigen::Vector3d effectAt(const Trajectory& trajectory, const SwathPoint& point,
                                const SystemVector& biases) {
  SensorPose pose;
  std::size_t cursor = 0;
  if (!trajectory.poseAt(point.time, pose, cursor)) return Eigen::Vector3d::Zero();
  return point.ground - corrected(pose, point.ground, biases);
}

}  // namespace pcl_als::test
