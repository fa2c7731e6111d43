// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
// Where the points are: on the scene, with the signs, the swath and the density that were asked
// for.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "blocks.h"

namespace {

using namespace pcl_als;
using namespace pcl_als::simulation;
using namespace pcl_als::simulation::test;

constexpr double kNothingThere = 1e30;

/// Distance of a point (local frame) to the nearest surface of its class, found without rays.
double distanceToSurface(const Scene& scene, const Eigen::Vector3d& p,
                         std::uint8_t classification) {
  if (classification == 2 || classification == 11)
    return std::abs(p.z() - scene.terrain().height(p.x(), p.y()));
  double nearest = kNothingThere;
  if (classification == 6)
    for (const Polygon& polygon : scene.polygons()) {
      if (((p - polygon.minimum()).array() < -1e-6).any() ||
          ((p - polygon.maximum()).array() > 1e-6).any())
        continue;
      const Eigen::Vector3d above = p + 10.0 * polygon.normal();
      if (const auto range = polygon.intersect(above, -polygon.normal()))
        nearest = std::min(nearest, std::abs(*range - 10.0));
    }
  if (classification == 5)
    for (const Ball& ball : scene.balls())
      nearest = std::min(nearest, std::abs((p - ball.centre).norm() - ball.radius));
  return nearest;
}

TEST(Simulator, WithoutNoiseAndBiasEveryPointLiesOnTheScene) {
  const Simulator simulator(oneLine());
  std::array<int, 12> count{};
  int on_edges = 0;
  for (const SimulatedPoint& point : simulator.strip(0)) {
    EXPECT_LT((point.position - point.surface).norm(), 1e-6);
    const Eigen::Vector3d local = point.position - simulator.options().origin;
    const double distance = distanceToSurface(simulator.scene(), local, point.classification);
    // A point on the very edge may miss its polygon by rounding.
    if (point.classification == 6 && distance == kNothingThere && ++on_edges < 5) continue;
    ASSERT_LT(distance, 1e-6) << int(point.classification) << " " << local.transpose();
    ++count[point.classification];
  }
  EXPECT_GT(count[2], 30000);
  EXPECT_GT(count[5], 500);
  EXPECT_GT(count[6], 500);
  EXPECT_GT(count[11], 1000);
}

TEST(Simulator, ABiasTakesThePointsOffTheScene) {
  SimulationOptions options = oneLine();
  setBias(options, SystemParameter::range_bias, 0.12);
  const Simulator simulator(options);
  std::size_t off = 0, ground = 0;
  for (const SimulatedPoint& point : simulator.strip(0)) {
    if (point.classification != 2) continue;
    ++ground;
    const Eigen::Vector3d local = point.position - options.origin;
    off += distanceToSurface(simulator.scene(), local, 2) > 0.1 ? 1 : 0;
  }
  EXPECT_GT(off, 0.99 * static_cast<double>(ground));
}

/// Mean displacement of the points within 2 degrees of the right (+1), left (-1) edge or of nadir.
Eigen::Vector3d meanEffectAtSide(const SimulationOptions& options, int side) {
  const double wanted = side * 19.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (const SimulatedPoint& p : Simulator(options).strip(0)) {
    if (std::abs(p.scan_angle - wanted) > 0.5) continue;
    sum += p.position - p.unbiased;
    ++count;
  }
  EXPECT_GT(count, 500U);
  return sum / static_cast<double>(count);
}

// At 19 degrees right of a line at 540 m: x = 540 tan 19 = 185.937, z = -540, b = -0.331613 rad.
// One degree of averaging, 2 m of height motion and 0.6 degrees of course allow two percent and,
// for what leaks through the course, 2 % of the largest component.
void expectBiasEffect(SystemParameter parameter, double value, int side, double right,
                      double forward, double up) {
  for (const bool north : {true, false}) {
    SimulationOptions options = overPlane();
    if (!north) options.lines = {lineAlong(1, {-75.0, 0.0}, {75.0, 0.0}, 540.0, 1.0)};
    setBias(options, parameter, value);
    const Eigen::Vector3d effect = meanEffectAtSide(options, side);
    const double tolerance = 0.02 * std::max({std::abs(right), std::abs(forward), std::abs(up)});
    // Flying north right is east; flying east right is south and forward is east.
    EXPECT_NEAR(north ? effect.x() : -effect.y(), right, tolerance);
    EXPECT_NEAR(north ? effect.y() : effect.x(), forward, tolerance);
    EXPECT_NEAR(effect.z(), up, tolerance);
  }
}

TEST(Simulator, LeverArmX) {
  expectBiasEffect(SystemParameter::lever_arm_x, 0.05, 0, 0.05, 0.0, 0.0);
}

TEST(Simulator, LeverArmY) {
  expectBiasEffect(SystemParameter::lever_arm_y, 0.05, 0, 0.0, 0.05, 0.0);
}

TEST(Simulator, LeverArmZ) {
  expectBiasEffect(SystemParameter::lever_arm_z, 0.05, 0, 0.0, 0.0, 0.05);
}

TEST(Simulator, BoresightPitch) {  // -z dw = 540 * 1.454441e-3
  expectBiasEffect(SystemParameter::boresight_pitch, 300.0, 0, 0.0, 0.785398, 0.0);
}

TEST(Simulator, BoresightRoll) {  // z df = -540 df; -x df = -185.937 df
  expectBiasEffect(SystemParameter::boresight_roll, 300.0, 1, -0.785398, 0.0, -0.270434);
  expectBiasEffect(SystemParameter::boresight_roll, 300.0, -1, -0.785398, 0.0, 0.270434);
}

TEST(Simulator, BoresightHeading) {  // x dk = 185.937 * 1.454441e-3
  expectBiasEffect(SystemParameter::boresight_heading, 300.0, 1, 0.0, 0.270434, 0.0);
  expectBiasEffect(SystemParameter::boresight_heading, 300.0, -1, 0.0, -0.270434, 0.0);
}

TEST(Simulator, RangeBias) {  // -sin b dr = 0.325568 dr; -cos b dr = -0.945519 dr
  expectBiasEffect(SystemParameter::range_bias, 0.12, 1, 0.039068, 0.0, -0.113462);
  expectBiasEffect(SystemParameter::range_bias, 0.12, 0, 0.0, 0.0, -0.12);
}

TEST(Simulator, ScanAngleScale) {  // z b dS = 540 * 0.331613 dS; -x b dS = 185.937 * 0.331613 dS
  expectBiasEffect(SystemParameter::scan_angle_scale, 1e-3, 1, 0.179071, 0.0, 0.061659);
  expectBiasEffect(SystemParameter::scan_angle_scale, 1e-3, -1, -0.179071, 0.0, 0.061659);
}

TEST(Simulator, TrueMountingDoesNotShowWhenItIsKnown) {
  SimulationOptions options = overPlane();
  options.mounting << 0.3, -0.2, 0.5, 2e-3, -3e-3, 5e-3, 0.8, 2e-3;
  for (const SimulatedPoint& point : Simulator(options).strip(0))
    ASSERT_NEAR(point.position.z(), options.origin.z(), 1e-6);
}

TEST(Simulator, FieldOfViewAndDensityAreAsPlanned) {
  const SimulationOptions options = overPlane();
  const Simulator simulator(options);
  const auto points = simulator.strip(0);
  // Swath 2 * 540 tan 20 deg = 393.09 m, 150 m long, one pulse per square metre.
  EXPECT_NEAR(static_cast<double>(points.size()), 58963.0, 2.0);
  double left = 0.0, right = 0.0, largest = 0.0;
  for (const SimulatedPoint& p : points) {
    left = std::min(left, p.position.x() - options.origin.x());
    right = std::max(right, p.position.x() - options.origin.x());
    largest = std::max<double>(largest, std::abs(p.scan_angle));
  }
  // The line sways by up to 3 m, the height by 2 m.
  EXPECT_NEAR(right - left, 393.09, 6.0);
  EXPECT_NEAR(largest, 20.0, 0.3);  // a turn of the course by 0.6 degrees takes part
}

TEST(Simulator, SpacingAcrossAndAlongIsAlike) {
  const auto points = Simulator(overPlane()).strip(0);
  std::size_t sweeps = 0, to_right = 0;
  for (const SimulatedPoint& p : points) {
    sweeps += (p.flags & 32U) != 0 ? 1 : 0;
    to_right += (p.flags & 16U) != 0 ? 1 : 0;
  }
  // 150 m with one sweep per metre, half of them to the right.
  EXPECT_NEAR(static_cast<double>(sweeps), 150.0, 1.0);
  EXPECT_NEAR(static_cast<double>(to_right) / points.size(), 0.5, 0.01);
}

TEST(Simulator, ScanDirectionFlagMeansTowardsTheRight) {
  const auto points = Simulator(overPlane()).strip(0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i - 1].flags & 32U) != 0) continue;  // the mirror turns
    const bool right = points[i].scan_angle > points[i - 1].scan_angle;
    ASSERT_EQ(right, (points[i].flags & 16U) != 0) << i;
  }
}

TEST(Simulator, ReturnsAreOrderedAndApart) {
  const Simulator simulator(oneLine());
  const auto points = simulator.strip(0);
  std::size_t multiple = 0;
  for (std::size_t i = 0; i < points.size(); i += points[i].number_of_returns) {
    const int count = points[i].number_of_returns;
    ASSERT_LE(count, simulator.options().scanner.max_returns);
    multiple += count > 1 ? 1 : 0;
    for (int k = 0; k < count; ++k) {
      ASSERT_EQ(points[i + k].return_number, k + 1);
      ASSERT_EQ(points[i + k].number_of_returns, count);
      ASSERT_EQ(points[i + k].time, points[i].time);
      if (k == 0) continue;
      const double apart = (points[i + k].surface - points[i + k - 1].surface).norm();
      ASSERT_GE(apart, simulator.options().scanner.return_separation - 1e-9);
      ASSERT_LT(points[i + k].surface.z(), points[i + k - 1].surface.z());
    }
  }
  EXPECT_GT(multiple, 200U);
}

TEST(Simulator, TimesIncreaseAndLieWithinTheTrajectory) {
  const Simulator simulator(SimulationOptions::preset("small", 0.2, 0.1));
  const auto trajectory = simulator.trajectory();
  double last = 0.0;
  for (const TrajectorySample& sample : trajectory) {
    ASSERT_GT(sample.time, last);
    last = sample.time;
  }
  double previous = 0.0;
  for (std::size_t i = 0; i < simulator.stripCount(); ++i)
    for (const SimulatedPoint& point : simulator.strip(i)) {
      ASSERT_GE(point.time, previous);
      previous = point.time;
      const auto after =
          std::lower_bound(trajectory.begin(), trajectory.end(), point.time,
                           [](const TrajectorySample& s, double time) { return s.time < time; });
      ASSERT_NE(after, trajectory.end());
      ASSERT_NE(after, trajectory.begin());
      ASSERT_LT(after->time - (after - 1)->time, 0.006) << "a point in a gap";
    }
}

TEST(Simulator, VerticalFlightHasNoAttitude) {
  for (const TrajectorySample& sample : Simulator(overPlane()).trajectory()) {
    ASSERT_EQ(sample.roll, 0.0);
    ASSERT_EQ(sample.pitch, 0.0);
  }
  SimulationOptions options = oneLine();
  double roll = 0.0, pitch = 0.0;
  const auto samples = Simulator(options).trajectory();
  for (const TrajectorySample& sample : samples) {
    roll = std::max(roll, std::abs(sample.roll));
    pitch += sample.pitch / static_cast<double>(samples.size());
  }
  EXPECT_GT(roll, 0.1 * kRadiansPerDegree);
  EXPECT_LE(roll, 0.5 * kRadiansPerDegree);
  EXPECT_NEAR(pitch, kRadiansPerDegree, 0.5 * kRadiansPerDegree);
}

TEST(Simulator, CrabStaysWithinItsLimitAndIsThere) {
  const auto samples = Simulator(oneLine()).trajectory();
  double largest = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Eigen::Vector3d step = samples[i].position - samples[i - 1].position;
    const double course = std::atan2(step.x(), step.y());
    largest = std::max(largest, std::abs(std::remainder(samples[i].heading - course, 2.0 * kPi)));
  }
  EXPECT_GT(largest, 1.0 * kRadiansPerDegree);
  EXPECT_LT(largest, 3.01 * kRadiansPerDegree);
}

}  // namespace
