// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
// The noise that is put in has the size and the correlation that the options state.
#include <cmath>
#include <utility>
#include <vector>

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

/// Ranges of a session have a common relative error, of another size in every block.
TEST(SimulatorNoise, RefractiveIndexScalesTheRanges) {
  SimulationOptions options = oneLine();
  RunningStatistics scales;
  for (options.seed = 1; options.seed <= 40; ++options.seed) {
    options.noise.refraction = 0.0;
    const SimulatedPoint exact = Simulator(options).strip(0).front();
    options.noise.refraction = 1e-4;
    const SimulatedPoint p = Simulator(options).strip(0).front();
    ASSERT_EQ(p.surface, exact.surface);
    // Along the pulse: the height of the sensor is 540 m above the ground, whose relief is 35 m.
    const double height = (p.position - exact.position).z() / 540.0;
    ASSERT_LT(std::abs(height), 5e-4);
    scales.add(height);
  }
  // Standard errors of 40 values: 1.6e-5 and 1.1e-5.
  EXPECT_NEAR(scales.mean(), 0.0, 5e-5);
  EXPECT_NEAR(scales.standardDeviation(), 1e-4, 4e-5);
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

/// Position errors of forty lines of 106 s each, in standard deviations, one vector per line and
/// axis; twenty samples per second.
std::vector<std::vector<double>> errorsOf(ErrorProcess process) {
  SimulationOptions options = longLine(1000.0);
  options.lines[0].speed = 10.0;  // 100 s and 3 s before and after
  for (std::uint16_t id = 2; id <= 40; ++id) {
    options.lines.push_back(options.lines[0]);
    options.lines.back().id = id;
  }
  options.trajectory_rate = 20.0;
  options.noise.process = process;
  const Simulator simulator(options);
  const auto written = simulator.trajectory(), exact = simulator.trueTrajectory();
  const std::size_t samples = written.size() / options.lines.size();
  std::vector<std::vector<double>> errors(3 * options.lines.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    const Eigen::Vector3d error = (written[i].position - exact[i].position) / 0.015;
    for (std::size_t axis = 0; axis < 3; ++axis)
      errors[3 * (i / samples) + axis].push_back(error[static_cast<Eigen::Index>(axis)]);
  }
  return errors;
}

/// Root mean square of the errors and of their changes within one second; share of no change.
struct ProcessFigures {
  RunningStatistics size, change;
  double unchanged = 0.0;

  explicit ProcessFigures(ErrorProcess process) {
    for (const std::vector<double>& errors : errorsOf(process)) {
      for (const double error : errors) size.add(error);
      for (std::size_t i = 20; i < errors.size(); ++i) {
        change.add(errors[i] - errors[i - 20]);
        unchanged += std::abs(errors[i] - errors[i - 20]) < 1e-6 ? 1.0 : 0.0;
      }
    }
    unchanged /= static_cast<double>(change.count());
  }
};

TEST(SimulatorNoise, EveryErrorProcessHasItsSizeAndItsChangeInOneSecond) {
  // Worked by hand: sqrt(2 (1 - e^-0.05)); the mean of 2 (1 - cos(2 pi / P)) over periods P whose
  // logarithms are uniform from 12 to 100 s; sqrt(1/106); 2 sqrt(1.5) / 106; sqrt(2).
  const std::vector<std::pair<ErrorProcess, double>> expected = {
      {ErrorProcess::gauss_markov, 0.312}, {ErrorProcess::band_limited, 0.249},
      {ErrorProcess::random_walk, 0.097},  {ErrorProcess::drift, 0.0231},
      {ErrorProcess::white, 1.414},        {ErrorProcess::jumps, 0.312}};
  for (const auto& [process, change] : expected) {
    const ProcessFigures figures(process);
    // 120 independent values at least: a root mean square is known to 1 / sqrt(240) = 6.5 %.
    EXPECT_NEAR(figures.size.rms(), 1.0, 0.2) << nameOf(process);
    EXPECT_NEAR(figures.change.rms(), change, 0.2 * change) << nameOf(process);
  }
}

TEST(SimulatorNoise, JumpsLeaveTheErrorsConstantInBetween) {
  // No jump within one second: e^(-1/20) = 0.951; 600 jumps in all scatter by 4 %.
  EXPECT_NEAR(ProcessFigures(ErrorProcess::jumps).unchanged, 0.951, 0.01);
  EXPECT_LT(ProcessFigures(ErrorProcess::gauss_markov).unchanged, 0.01);
}

TEST(SimulatorNoise, BandLimitedErrorsAreSmooth) {
  // Second differences over 0.05 s of the shortest period: at most (2 pi 0.05 / 12)^2 = 7e-4 of
  // the amplitude, which is below 5 standard deviations; a Gauss-Markov process has 0.1.
  for (const std::vector<double>& errors : errorsOf(ErrorProcess::band_limited)) {
    for (std::size_t i = 2; i < errors.size(); ++i)
      ASSERT_LT(std::abs(errors[i] - 2.0 * errors[i - 1] + errors[i - 2]), 3.5e-3);
  }
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
