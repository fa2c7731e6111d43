// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/trajectory_reconstruction.h>

namespace pcl_als {
namespace {

// Where the ground rises ahead by a tenth, the middle of a disc of pulses lies 0.1 tan(20)^2 / 4 of
// the height behind: 9 m.
TEST(PathOverSlopes, SlopesDoNotMoveTheMiddleOfADisc) {
  const auto positionAt = [](double slope) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<LidarReturn> points;
    for (int i = 0; i < 60000; ++i) {
      LidarReturn point;
      point.time = i / 3000.0;
      const Eigen::Vector3d sensor(0.0, 50.0 * point.time, 1000.0 + slope * 50.0 * point.time);
      const double turn = 2.0 * kPi * uniform(random);
      const double size = 0.364 * std::sqrt(uniform(random));
      const Eigen::Vector3d ray(size * std::sin(turn), size * std::cos(turn), -1.0);
      // sensor.z - r = slope (sensor.y + r ray.y)
      const double range = (sensor.z() - slope * sensor.y()) / (1.0 + slope * ray.y());
      point.position = sensor + range * ray;
      point.scan_angle = static_cast<float>(std::atan(ray.x()) / kRadiansPerDegree);
      point.number_of_returns = point.return_number = 1;
      points.push_back(point);
    }
    TrajectoryReconstruction reconstruction;
    reconstruction.add(reconstruction.addStrip("1"), points.data(), points.size());
    const ReconstructedPath path = reconstruction.reconstruct().front();
    EXPECT_TRUE(path.found) << path.reason;
    const PathSample& middle = path.samples[path.samples.size() / 2];
    return middle.position.y() - 50.0 * middle.time;
  };
  EXPECT_NEAR(positionAt(0.1), positionAt(0.0), 1.5);
}

}  // namespace
}  // namespace pcl_als
