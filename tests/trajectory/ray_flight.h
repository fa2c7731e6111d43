// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/trajectory_reconstruction.h>

namespace pcl_als::test {

using Points = std::vector<LidarReturn>;

/// Points of a linear scanner over a plane at height 0 with trees: each pulse's returns lie on a
/// line through the sensor, written without any equation of the reconstruction.
struct RayFlight {
  std::function<Eigen::Vector3d(double)> path;  ///< metres, of a time in seconds
  std::function<double(double)> roll = [](double) { return 0.0; };   ///< radians
  std::function<double(double)> pitch = [](double) { return 0.0; };  ///< radians, nose up
  double from = 0.0, to = 20.0;                                      ///< seconds
  double course = 0.0;           ///< radians clockwise from north, of the scan planes
  double pulses = 2000.0;        ///< per second
  double half_angle = 20.0;      ///< degrees
  double lines = 25.0;           ///< per second
  double trees = 0.2;            ///< share of the pulses with two returns
  double tree_height = 12.0;     ///< metres, the highest
  double noise = 0.01;           ///< metres, each coordinate of each return
  double angle_step = 1.0;       ///< degrees of recorded angles; 0: none are recorded
  double angle_sign = 1.0;       ///< 1: positive to the right
  bool angles_with_roll = true;  ///< from the vertical, else from the body
  unsigned seed = 1;

  std::vector<LidarReturn> points() const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, noise);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<LidarReturn> all;
    const auto count = static_cast<std::int64_t>((to - from) * pulses);
    for (std::int64_t i = 0; i < count; ++i) {
      const double time = from + static_cast<double>(i) / pulses;
      const double sweep = 2.0 * std::abs(2.0 * std::fmod(0.5 * lines * time, 1.0) - 1.0) - 1.0;
      const double angle = sweep * half_angle * kRadiansPerDegree;
      const double vertical = angle - roll(time);  // to the right
      const Eigen::Vector3d sensor = path(time);
      const double ahead = std::sin(pitch(time)), level = std::cos(pitch(time));
      const double aside = level * std::sin(vertical);
      const Eigen::Vector3d down(std::cos(course) * aside + std::sin(course) * ahead,
                                 -std::sin(course) * aside + std::cos(course) * ahead,
                                 -level * std::cos(vertical));
      const bool tree = uniform(random) < trees;
      const double top = tree ? tree_height * (0.2 + 0.8 * uniform(random)) : 0.0;
      for (int k = tree ? 0 : 1; k < 2; ++k) {
        LidarReturn& point = all.emplace_back();
        const double height = k == 0 ? top : 0.0;
        point.position = sensor + (sensor.z() - height) / -down.z() * down +
                         Eigen::Vector3d(normal(random), normal(random), normal(random));
        point.time = time;
        point.number_of_returns = tree ? 2 : 1;
        point.return_number = tree ? static_cast<std::uint8_t>(k + 1) : 1;
        const double recorded =
            angle_sign * (angles_with_roll ? vertical : angle) / kRadiansPerDegree;
        point.scan_angle = angle_step > 0.0
                               ? static_cast<float>(angle_step * std::round(recorded / angle_step))
                               : 0.0F;
      }
    }
    return all;
  }
};

/// 60 m/s to the north at 1000 m, with slow movements of some decimetres to metres.
inline Eigen::Vector3d wavyPath(double time) {
  return {3.0 * std::sin(0.4 * time), 60.0 * time + 0.5 * std::sin(0.7 * time),
          1000.0 + 1.5 * std::cos(0.3 * time)};
}

inline RayFlight wavy() {
  RayFlight flight;
  flight.path = wavyPath;
  return flight;
}

/// What is reconstructed of strips "1", "2" …
inline std::vector<ReconstructedPath> pathsOf(const std::vector<Points>& strips) {
  TrajectoryReconstruction reconstruction;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const int strip = reconstruction.addStrip(std::to_string(i + 1));
    reconstruction.add(strip, strips[i].data(), strips[i].size());
  }
  return reconstruction.reconstruct();
}

/// The path of one strip.
inline ReconstructedPath pathOf(const Points& strip) {
  const std::vector<ReconstructedPath> paths = pathsOf({strip});
  EXPECT_EQ(paths.size(), 1U);
  return paths.front();
}

}  // namespace pcl_als::test
