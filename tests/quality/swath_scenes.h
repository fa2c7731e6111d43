// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <pcl_als/quality/area_offsets.h>

namespace pcl_als::test {

/// Roofs of four directions on gently rolling ground: z at (x, y), metres. Within 60 m x 60 m.
inline double village(double x, double y) {
  const double ground = 0.3 * std::sin(x / 9.0) + 0.3 * std::cos(y / 11.0);
  for (const double cx : {15.0, 45.0}) {
    for (const double cy : {15.0, 45.0}) {
      const double dx = std::abs(x - cx), dy = std::abs(y - cy);
      if (dx > 6.0 || dy > 6.0) continue;
      const bool along_x = (cx < 30.0) == (cy < 30.0);  // two ridges each way
      return 8.0 - 0.6 * (along_x ? dy : dx);           // 31 degrees
    }
  }
  return ground;
}

/// How one strip sees a surface.
struct Flight {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< of all its points, metres
  double tilt = 0.0;     ///< metres of height per metre east of the middle (30 m)
  double noise = 0.0;    ///< metres, of height
  double spacing = 0.5;  ///< metres between points
  double time = 1000.0;  ///< seconds at y = 0, flying north (south: speed < 0)
  double speed = 60.0;   ///< metres per second
  unsigned seed = 1;
};

/// Points of a strip over [0, 60] x [0, 60], jittered, at UTM-like coordinates.
inline std::vector<LidarReturn> fly(const std::function<double(double, double)>& surface,
                                    const Flight& flight, const Eigen::Vector3d& origin) {
  std::mt19937 random(flight.seed);
  std::uniform_real_distribution<double> jitter(-0.4, 0.4);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<LidarReturn> points;
  for (double y = 0.0; y <= 60.0; y += flight.spacing) {
    for (double x = 0.0; x <= 60.0; x += flight.spacing) {
      const double px = x + flight.spacing * jitter(random),
                   py = y + flight.spacing * jitter(random);
      LidarReturn point;
      const double z = surface(px, py) + flight.tilt * (px - 30.0) + flight.noise * noise(random);
      point.position = origin + Eigen::Vector3d(px, py, z) + flight.shift;
      point.position = (point.position * 1000.0).array().round() / 1000.0;
      point.time = flight.time + py / flight.speed;
      point.scan_angle = static_cast<float>((flight.speed > 0.0 ? 1.0 : -1.0) * (px - 30.0));
      points.push_back(point);
    }
  }
  return points;
}

inline const Eigen::Vector3d kOrigin{691000.0, 5335000.0, 500.0};

/// An area of 50 m x 50 m in the middle with both strips, built.
inline AreaOffsets areaOf(const std::vector<LidarReturn>& a, const std::vector<LidarReturn>& b,
                          const SurfaceLimits& limits = {}) {
  AreaOffsets area({kOrigin.head<2>() + Eigen::Vector2d(5.0, 5.0), 50.0, 5.0}, 2);
  for (const LidarReturn& point : a) area.add(0, point);
  for (const LidarReturn& point : b) area.add(1, point);
  area.build(limits, 0.001);
  area.choosePlaces();
  return area;
}

}  // namespace pcl_als::test
