// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
// Size and sign of every error source on the ground, against figures computed by hand.
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/lidar_system.h>

#include "blocks.h"

namespace {

using namespace pcl_als;
using namespace pcl_als::simulation;
using namespace pcl_als::simulation::test;

/// A vertical flight north at 540 m above a plane with errors.
SimulationOptions withErrors(const char* errors) {
  SimulationOptions options = overPlane();
  options.errors.add(errors);
  return options;
}

Eigen::Vector3d effectOf(const SimulatedPoint& point) {
  return point.position - point.unbiased;
}

using Choice = std::function<bool(const SimulatedPoint&)>;

Choice atAngle(double degrees) {  // right of flight is positive
  return [degrees](const SimulatedPoint& p) { return std::abs(p.scan_angle - degrees) < 0.5; };
}

Eigen::Vector3d meanEffectOf(const SimulationOptions& options, const Choice& chosen,
                             std::size_t strip = 0) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (const SimulatedPoint& p : Simulator(options).strip(strip)) {
    if (!chosen(p)) continue;
    sum += effectOf(p);
    ++count;
  }
  EXPECT_GT(count, 200U);
  return sum / static_cast<double>(count);
}

/// Two percent of the largest component: one degree of averaging, 2 m of height motion and 0.6
/// degrees of course, as in the tests of the system parameters.
void expectComponents(const Eigen::Vector3d& effect, double east, double north, double up) {
  const double tolerance = 0.02 * std::max({std::abs(east), std::abs(north), std::abs(up)});
  EXPECT_NEAR(effect.x(), east, tolerance);
  EXPECT_NEAR(effect.y(), north, tolerance);
  EXPECT_NEAR(effect.z(), up, tolerance);
}

TEST(ErrorSources, TimeOffsetShiftsAlongTheFlightAndTheTags) {
  // 10 ms late at 60 m/s (which varies by 5 %): 0.6 m ahead.
  const SimulationOptions options = withErrors("time_offset=10");
  const Eigen::Vector3d effect = meanEffectOf(options, atAngle(0.0));
  EXPECT_NEAR(effect.y(), 0.6, 0.03);
  EXPECT_NEAR(effect.x(), 0.0, 0.01);
  const auto late = Simulator(options).strip(0), exact = Simulator(overPlane()).strip(0);
  ASSERT_EQ(late.size(), exact.size());
  for (std::size_t i = 0; i < late.size(); i += 97) {
    ASSERT_NEAR(late[i].time - exact[i].time, 0.01, 1e-9);
    ASSERT_LT((late[i].surface - exact[i].surface).norm(), 1e-9);
  }
}

TEST(ErrorSources, TimeOffsetTurnsWithTheAttitude) {
  SimulationOptions options = oneLine();
  options.errors.add("time_offset=10");
  const Simulator simulator(options);
  const auto track = simulator.trueTrajectory();
  const auto points = simulator.strip(0);
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); i += 501) {
    // The tags are 2 samples late; true poses at the sample before each time.
    const double place = (points[i].time - track[0].time) * 200.0;
    const auto at = static_cast<std::size_t>(place);
    const TrajectorySample &a = track[at - 2], &b = track[at];
    const Eigen::Matrix3d turn = groundFromBody(b.roll, b.pitch, b.heading) *
                                 groundFromBody(a.roll, a.pitch, a.heading).transpose();
    const Eigen::Vector3d arm = points[i].surface - a.position;
    const Eigen::Vector3d expected = b.position - a.position + turn * arm - arm;
    // Within the 5 ms of a sample the rates change by a per cent.
    ASSERT_LT((effectOf(points[i]) - expected).norm(), 0.01) << i;
    largest = std::max(largest, (turn * arm - arm).norm());
  }
  EXPECT_GT(largest, 0.02) << "the attitude has to change";
}

TEST(ErrorSources, MirrorTorsionChangesSignWithTheScanDirection) {
  // 100 arcsec = 4.848137e-4 rad; z d_b = -540 m * 4.848137e-4: to the left in sweeps to the right.
  const SimulationOptions options = withErrors("mirror_torsion=100");
  const auto moving = [](bool right) -> Choice {
    return [right](const SimulatedPoint& p) {
      return std::abs(p.scan_angle) < 0.5 && ((p.flags & 16) != 0) == right;
    };
  };
  expectComponents(meanEffectOf(options, moving(true)), -0.261799, 0.0, 0.0);
  expectComponents(meanEffectOf(options, moving(false)), 0.261799, 0.0, 0.0);
}

// At 19 degrees right x = 185.937, z = -540, b = -0.331613 rad; dX = z d_b, dZ = -x d_b.
TEST(ErrorSources, EncoderQuadratic) {  // d_b = 0.01 * 0.1099669
  const SimulationOptions options = withErrors("encoder_quadratic=0.01");
  expectComponents(meanEffectOf(options, atAngle(19.0)), -0.593821, 0.0, -0.204470);
  expectComponents(meanEffectOf(options, atAngle(-19.0)), -0.593821, 0.0, 0.204470);
}

TEST(ErrorSources, EncoderCubic) {  // d_b = -0.01 * 0.0364664 on the right
  const SimulationOptions options = withErrors("encoder_cubic=0.01");
  expectComponents(meanEffectOf(options, atAngle(19.0)), 0.196919, 0.0, 0.067805);
  expectComponents(meanEffectOf(options, atAngle(-19.0)), -0.196919, 0.0, 0.067805);
}

TEST(ErrorSources, DeflectionScaleWidensTheCone) {
  SimulationOptions options = withErrors("deflection_scale=0.001");
  options.setScanner("conical");
  // The angle grows by 0.001 * 20 degrees = 3.490659e-4 rad; at 540 m / cos 20 = 574.6560 m this
  // is 0.2005929 m, 0.188496 m of them outwards and 0.068607 m up.
  const auto ahead = [](const SimulatedPoint& p) {
    return std::abs(p.scan_angle) < 1.0 && (p.flags & 16) != 0;  // to the right ahead
  };
  const auto behind = [](const SimulatedPoint& p) {
    return std::abs(p.scan_angle) < 1.0 && (p.flags & 16) == 0;
  };
  expectComponents(meanEffectOf(options, ahead), 0.0, 0.188496, 0.068607);
  expectComponents(meanEffectOf(options, behind), 0.0, -0.188496, 0.068607);
  expectComponents(
      meanEffectOf(options, [](const SimulatedPoint& p) { return p.scan_angle > 19.9; }), 0.188496,
      0.0, 0.068607);
}

TEST(ErrorSources, RangeScale) {  // d_r = 0.54 m at nadir, 0.571115 m at 19 degrees
  const SimulationOptions options = withErrors("range_scale=0.001");
  expectComponents(meanEffectOf(options, atAngle(0.0)), 0.0, 0.0, -0.54);
  expectComponents(meanEffectOf(options, atAngle(19.0)), 0.185937, 0.0, -0.54);
}

TEST(ErrorSources, RangeWalkFollowsTheIntensity) {
  const SimulationOptions options = withErrors("range_walk=0.1");
  ASSERT_EQ(options.rangeWalkReference(), 1000.0);
  double least = 1e9, largest = -1e9;
  for (const SimulatedPoint& p : Simulator(options).strip(0)) {
    // A tenth of the intensity is measured 0.1 m too long.
    const double expected = 0.1 * std::log10(1000.0 / p.intensity);
    ASSERT_NEAR(effectOf(p).norm(), std::abs(expected), 1e-6);
    ASSERT_EQ(effectOf(p).z() < 0.0, expected > 0.0);
    least = std::min(least, expected);
    largest = std::max(largest, expected);
  }
  EXPECT_GT(largest - least, 0.03);
}

TEST(ErrorSources, RangeIncidenceIsAShareOfTheStretchedPulse) {
  // 571.115 m * 0.33e-3 * tan 19 = 0.0648945 m, half of it along the beam.
  const SimulationOptions options = withErrors("range_incidence=0.5");
  expectComponents(meanEffectOf(options, atAngle(19.0)), 0.010564, 0.0, -0.030679);
  EXPECT_LT(meanEffectOf(options, atAngle(0.0)).norm(), 1e-3);
}

TEST(ErrorSources, ChannelsHaveTheirOwnParameters) {
  SimulationOptions options = overPlane();
  options.setScanner("cross");
  options.errors.add("channel1:boresight_roll=300,channel1:range_bias=0.1");
  const auto of = [](int channel) -> Choice {
    return [channel](const SimulatedPoint& p) {
      return p.channel == channel && std::abs(p.scan_angle) < 0.5;
    };
  };
  EXPECT_LT(meanEffectOf(options, of(0)).norm(), 1e-9);
  expectComponents(meanEffectOf(options, of(1)), -0.785398, 0.0,
                   -0.1);  // z df = -540 * 1.454441e-3
}

TEST(ErrorSources, ASessionIsShiftedWithItsTrajectory) {
  SimulationOptions options = overPlane();
  options.lines.push_back(lineAlong(2, {50.0, -75.0}, {50.0, 75.0}, 540.0, 1.0));
  options.setSessions(2);
  options.errors.add("session2:offset_z=0.08,session2:offset_x=-0.5,session2:range_bias=0.02");
  const auto all = [](const SimulatedPoint& p) { return std::abs(p.scan_angle) < 1.0; };
  EXPECT_LT(meanEffectOf(options, all, 0).norm(), 1e-9);
  expectComponents(meanEffectOf(options, all, 1), -0.5, 0.0, 0.06);
  const Simulator simulator(options);
  const auto written = simulator.trajectory(), exact = simulator.trueTrajectory();
  EXPECT_LT((written.front().position - exact.front().position).norm(), 1e-9);
  const Eigen::Vector3d shift = written.back().position - exact.back().position;
  EXPECT_LT((shift - Eigen::Vector3d(-0.5, 0.0, 0.08)).norm(), 1e-8);
  EXPECT_GT(simulator.strip(1)[0].time - simulator.strip(0)[0].time, 86400.0);
}

TEST(ErrorSources, AJumpBeginsInTheMiddleOfTheStrip) {
  const Simulator simulator(withErrors("strip1:jump_z=0.1"));
  const auto points = simulator.strip(0);
  const std::size_t middle = points.size() / 2;
  for (std::size_t i = 0; i < points.size(); i += 11) {
    if (i + 400 > middle && i < middle + 400) continue;  // half a sample of the trajectory
    ASSERT_NEAR(effectOf(points[i]).z(), i < middle ? 0.0 : 0.1, 1e-6) << i;
  }
  const auto written = simulator.trajectory(), exact = simulator.trueTrajectory();
  const double z = written.back().position.z() - exact.back().position.z();
  EXPECT_NEAR(z, 0.1, 1e-8);
}

TEST(ErrorSources, SumsOfScopes) {
  ErrorSources errors;
  errors.add("range_scale=1e-5,session2:range_scale=2e-5,strip7:range_scale=4e-5");
  const auto scale = [&](int session, int strip) {
    return errors.of(session, strip, 0).of(ErrorSource::range_scale);
  };
  EXPECT_NEAR(scale(1, 1), 1e-5, 1e-12);
  EXPECT_NEAR(scale(2, 1), 3e-5, 1e-12);
  EXPECT_NEAR(scale(2, 7), 7e-5, 1e-12);
}

TEST(ErrorSources, WrongEntriesAreNamed) {
  const auto message = [](const std::string& text, const char* scanner = "oscillating") {
    try {
      SimulationOptions options = overPlane();
      options.setScanner(scanner);
      options.errors.add(text);
      options.check();
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto says = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  EXPECT_EQ(message("time_offset=1"), "");
  EXPECT_TRUE(says(message("clock=1"), "time_offset"));
  EXPECT_TRUE(says(message("time_offset"), "NAME=VALUE"));
  EXPECT_TRUE(says(message("time_offset=soon"), "time_offset=soon"));
  EXPECT_TRUE(says(message("time_offset=1e9"), "1000 ms"));
  EXPECT_TRUE(says(message("day2:offset_z=1"), "'day2'"));
  EXPECT_TRUE(says(message("session2:offset_z=1"), "there is no session 2"));
  EXPECT_TRUE(says(message("channel1:range_bias=1"), "there is no channel 1"));
  EXPECT_TRUE(says(message("channel0:offset_z=1"), "no trajectory"));
  EXPECT_TRUE(says(message("boresight_roll=1"), "bias"));
  EXPECT_TRUE(says(message("mirror_torsion=1", "polygon"), "mirror_torsion"));
  EXPECT_TRUE(says(message("encoder_cubic=1e-3", "conical"), "encoder_cubic"));
  EXPECT_TRUE(says(message("deflection_scale=1e-3"), "scan_angle_scale"));
}

}  // namespace
