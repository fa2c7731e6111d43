// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
// The noise that is put in has the size and the correlation that the options state.
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/statistics.h>

#include "blocks.h"

namespace {

using namespace pcl_als;
using namespace pcl_als::simulation;
using namespace pcl_als::simulation::test;

/// One long line whose trajectory can be looked at; hardly any pulses.
SimulationOptions longLine(double length) {
  SimulationOptions options;
  options.lines = {lineAlong(1, {0.0, -0.5 * length}, {0.0, 0.5 * length}, 540.0, 1e-3)};
  options.lines[0].speed = 10.0;  // 2500 s
  options.scanner.field_of_view = 2.0 * kRadiansPerDegree;
  options.scene.buildings = options.scene.trees = options.scene.relief = 0.0;
  options.noise = NoiseOptions::named("realistic");
  return options;
}

TEST(SimulatorNoise, NoneIsExact) {
  for (const SimulatedPoint& p : Simulator(oneLine()).strip(0))
    ASSERT_LT((p.unbiased - p.surface).norm(), 1e-6);
}

TEST(SimulatorNoise, RangeNoiseIsTwoCentimetresAlongTheBeam) {
  SimulationOptions options = oneLine();
  options.noise = NoiseOptions::named("range");
  const Simulator simulator(options);
  RunningStatistics along;
  const auto exact = Simulator(oneLine()).strip(0);
  const auto noisy = simulator.strip(0);
  ASSERT_EQ(exact.size(), noisy.size());
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    ASSERT_EQ(noisy[i].surface, exact[i].surface);  // nothing else changes
    ASSERT_EQ(noisy[i].intensity, exact[i].intensity);
    const Eigen::Vector3d error = noisy[i].position - noisy[i].surface;
    along.add(error.z() > 0.0 ? -error.norm() : error.norm());
  }
  // Standard error of a standard deviation from 60,000 values: 0.02 / sqrt(120,000) = 6e-5.
  EXPECT_NEAR(along.standardDeviation(), 0.02, 3e-4);
  EXPECT_NEAR(along.mean(), 0.0, 4e-4);
}

TEST(SimulatorNoise, TrajectoryErrorsHaveTheirSize) {
  const Simulator simulator(longLine(25000.0));
  const auto written = simulator.trajectory(), exact = simulator.trueTrajectory();
  RunningStatistics position, roll, pitch, heading;
  for (std::size_t i = 0; i < written.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      position.add(written[i].position[axis] - exact[i].position[axis]);
    roll.add(written[i].roll - exact[i].roll);
    pitch.add(written[i].pitch - exact[i].pitch);
    heading.add(std::remainder(written[i].heading - exact[i].heading, 2.0 * kPi));
  }
  // 2500 s hold 125 correlation times: a standard deviation is known to 1 / sqrt(125) = 9 %,
  // the position's (three axes) to 5 %. Three of them.
  EXPECT_NEAR(position.rms(), 0.015, 0.15 * 0.015);
  EXPECT_NEAR(roll.rms() / kRadiansPerArcsec, 8.0, 0.27 * 8.0);
  EXPECT_NEAR(pitch.rms() / kRadiansPerArcsec, 8.0, 0.27 * 8.0);
  EXPECT_NEAR(heading.rms() / kRadiansPerArcsec, 16.0, 0.27 * 16.0);
}

TEST(SimulatorNoise, TrajectoryErrorsDriftOverTwentySeconds) {
  const Simulator simulator(longLine(25000.0));
  const auto written = simulator.trajectory(), exact = simulator.trueTrajectory();
  const auto correlation = [&](std::size_t lag) {
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i + lag < written.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const double a = written[i].position[axis] - exact[i].position[axis];
        product += a * (written[i + lag].position[axis] - exact[i + lag].position[axis]);
        square += a * a;
      }
    return product / square;
  };
  EXPECT_GT(correlation(200), 0.93);                     // 1 s: exp(-1/20) = 0.951
  EXPECT_NEAR(correlation(4000), std::exp(-1.0), 0.15);  // 20 s; known to 0.05
  EXPECT_LT(std::abs(correlation(20000)), 0.25);         // 100 s
}

TEST(SimulatorNoise, PointsFollowTheWrittenTrajectory) {
  // Flat ground: a point's height error is the position's, the tilt's and the range's.
  SimulationOptions options = overPlane();
  options.noise.position = 0.5;
  options.noise.correlation_time = 1e5;  // practically a constant shift
  const Simulator simulator(options);
  const Eigen::Vector3d shift =
      simulator.trajectory().front().position - simulator.trueTrajectory().front().position;
  ASSERT_GT(shift.norm(), 0.05);
  for (const SimulatedPoint& p : simulator.strip(0))
    ASSERT_LT((p.position - p.surface - shift).norm(), 0.05);  // it drifts by 0.5 sqrt(2 * 5/1e5)
}

TEST(SimulatorNoise, EncoderNoiseMovesAcrossOnly) {
  SimulationOptions options = overPlane();
  options.noise.scan_angle = 20.0 * kRadiansPerArcsec;
  RunningStatistics across, along;
  for (const SimulatedPoint& p : Simulator(options).strip(0)) {
    if (std::abs(p.scan_angle) > 1.0) continue;
    across.add(p.position.x() - p.surface.x());
    along.add(p.position.y() - p.surface.y());
  }
  // 540 m * 20 arcsec = 0.05236 m; 3000 values: 1.3 %. The course turns by 0.6 degrees: 1 %.
  EXPECT_NEAR(across.standardDeviation(), 0.05236, 0.04 * 0.05236);
  EXPECT_LT(along.standardDeviation(), 0.02 * 0.05236);
}

TEST(SimulatorNoise, FootprintMakesReturnsAtEdgesAndLeavesOpenGround) {
  SimulationOptions options = oneLine();
  const auto axis_points = Simulator(options).strip(0);
  options.noise.footprint = true;
  const Simulator simulator(options);
  std::size_t off_surface = 0, ground = 0, ground_off = 0;
  const auto points = simulator.strip(0);
  for (const SimulatedPoint& p : points) {
    const Eigen::Vector3d local = p.surface - options.origin;
    if (p.classification == 2 && p.number_of_returns == 1) {
      const double off =
          std::abs(local.z() - simulator.scene().terrain().height(local.x(), local.y()));
      ++ground;
      ground_off += off > 1e-3 ? 1 : 0;
    }
    if (p.classification == 6 && p.number_of_returns > 1) ++off_surface;
  }
  EXPECT_GT(off_surface, 20U) << "no pulse was split at an eave";
  EXPECT_LT(ground_off, ground / 200) << "mixed returns away from objects";
  EXPECT_GT(points.size(), axis_points.size());
}

TEST(SimulatorNoise, SlopeBroadensTheEcho) {
  // A footprint of 2 mrad at 540 m on the swath's edge (20 degrees): spread 0.25 * 2e-3 * r * tan,
  // r = 574.7 m: 0.1046 m, a tenth of it in quadrature with the range noise of 1 mm.
  SimulationOptions options = overPlane();
  options.scanner.divergence = 2e-3;
  options.noise.footprint = true;
  options.noise.range = 0.001;
  RunningStatistics edge, nadir;
  for (const SimulatedPoint& p : Simulator(options).strip(0)) {
    const double error = (p.position - p.surface).norm();
    if (std::abs(p.scan_angle) > 19.5) edge.add(error);
    if (std::abs(p.scan_angle) < 0.5) nadir.add(error);
  }
  EXPECT_NEAR(edge.rms(), 0.0103, 0.0006);  // 0.5 degree of averaging, 1500 values
  EXPECT_NEAR(nadir.rms(), 0.001, 0.0001);
}

TEST(SimulatorNoise, IntensityNoiseIsRelative) {
  SimulationOptions options = overPlane();
  const auto exact = Simulator(options).strip(0);
  options.noise.intensity = 0.03;
  const auto noisy = Simulator(options).strip(0);
  RunningStatistics ratio;
  for (std::size_t i = 0; i < noisy.size(); ++i)
    ratio.add(static_cast<double>(noisy[i].intensity) / exact[i].intensity);
  EXPECT_NEAR(ratio.standardDeviation(), 0.03, 0.001);
  EXPECT_NEAR(ratio.mean(), 1.0, 0.001);
}

}  // namespace
