// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Reconstructed paths of points that contradict themselves, and of short strips.
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/trajectory/trajectory_reconstruction.h>

#include "ray_flight.h"

namespace pcl_als {
namespace {

using test::pathOf;
using test::Points;
using test::RayFlight;
using test::wavy;
using test::wavyPath;

/// Root mean squares over time of the errors over their standard deviations.
Eigen::Vector3d normalised(const ReconstructedPath& path) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (const PathSample& sample : path.samples)
    squares += (sample.position - wavyPath(sample.time))
                   .cwiseAbs2()
                   .cwiseQuotient(sample.covariance.diagonal());
  return (squares / static_cast<double>(path.samples.size())).cwiseSqrt();
}

/// Multiplies the recorded angles of points, as where their unit is another.
void scaleAngles(Points& points, float factor) {
  for (LidarReturn& point : points) point.scan_angle *= factor;
}

/// Without rays, angles of ten times the size fit no plane scan.
TEST(PathRefusals, RefusesScanAnglesOfAnotherUnit) {
  for (const double half_angle : {5.0, 7.0}) {
    RayFlight flight = wavy();
    flight.half_angle = half_angle;
    flight.angle_step = 0.006;
    flight.trees = 0.0;
    Points points = flight.points();
    scaleAngles(points, 10.0F);
    const ReconstructedPath path = pathOf(points);
    EXPECT_FALSE(path.found) << path.height << " m " << path.meanStd().transpose();
    EXPECT_NE(path.reason.find("scan angles"), std::string::npos) << path.reason;
  }
}

/// Rays that agree with each other are believed; where they are too few, the strip is refused.
TEST(PathRefusals, DoesNotBelieveScanAnglesThatContradictRays) {
  for (const double trees : {0.2, 0.01}) {
    RayFlight flight = wavy();
    flight.to = 3.0;
    flight.trees = trees;
    flight.noise = 0.02;
    flight.angle_step = 0.006;
    Points points = flight.points();
    scaleAngles(points, 3.0F);
    const ReconstructedPath path = pathOf(points);
    if (!path.found) {
      EXPECT_NE(path.reason.find("scan angles"), std::string::npos) << path.reason;
      continue;
    }
    EXPECT_NEAR(path.height, 1000.0, 30.0);
    EXPECT_LT(normalised(path).maxCoeff(), 2.5);
    EXPECT_LT(path.rejected, path.rays / 2);
  }
}

/// Standard deviations of short strips with few rays.
TEST(PathRefusals, ShortStripsAreRightOrUncertain) {
  int found = 0;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (unsigned seed = 1; seed <= 40; ++seed) {
    RayFlight flight = wavy();
    flight.to = seed % 2 == 0 ? 1.2 : 2.0;
    flight.trees = seed % 3 == 0 ? 0.1 : 0.01;
    flight.noise = 0.02;
    flight.angle_step = seed % 4 == 0 ? 1.0 : 0.0;
    flight.seed = seed;
    const ReconstructedPath path = pathOf(flight.points());
    if (!path.found) continue;
    ++found;
    const Eigen::Vector3d is = normalised(path);
    squares += is.cwiseAbs2();
    EXPECT_LT(is.maxCoeff(), 5.0) << seed << ": " << is.transpose();
    for (const PathSample& sample : path.samples) EXPECT_LT(sample.velocity.norm(), 250.0) << seed;
  }
  EXPECT_GT(found, 20);
  const Eigen::Vector3d overall = (squares / found).cwiseSqrt();
  EXPECT_LT(overall.maxCoeff(), 1.6) << overall.transpose();
}

TEST(PathRefusals, RefusesPathsThatNoAircraftFlies) {
  RayFlight flight = wavy();
  flight.to = 3.0;
  flight.path = [](double time) { return Eigen::Vector3d(0.0, 450.0 * time, 1000.0); };
  const ReconstructedPath path = pathOf(flight.points());
  EXPECT_FALSE(path.found);
  EXPECT_NE(path.reason.find("m/s"), std::string::npos) << path.reason;
  flight.path = [](double time) {
    return Eigen::Vector3d(0.0, 60.0 * time, 1000.0 + 300.0 * time);
  };
  EXPECT_FALSE(pathOf(flight.points()).found);
}

}  // namespace
}  // namespace pcl_als
