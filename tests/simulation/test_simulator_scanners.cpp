// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
// Directions of the pulses of every scanner over a plane, against figures computed by hand.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "blocks.h"

namespace {

using namespace pcl_als;
using namespace pcl_als::simulation;
using namespace pcl_als::simulation::test;

/// A vertical flight north at 540 m above a plane; one pulse per square metre and channel.
SimulationOptions over(const char* scanner) {
  SimulationOptions options = overPlane();
  options.setScanner(scanner);
  options.lines[0].density = options.scanner.channels;
  return options;
}

struct Pulse {
  SimulatedPoint point;
  Eigen::Vector3d beam;  ///< unit vector in the body frame, right-forward-up
};

/// The pulses with their directions: between its samples the trajectory is linear.
std::vector<Pulse> pulsesOf(const Simulator& simulator) {
  const auto track = simulator.trueTrajectory();
  const double rate = simulator.options().trajectory_rate;
  std::vector<Pulse> pulses;
  for (const SimulatedPoint& point : simulator.strip(0)) {
    const double place = (point.time - track[0].time) * rate;
    const auto before = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(before);
    const TrajectorySample &a = track[before], &b = track[before + 1];
    const Eigen::Vector3d from = point.surface - (1.0 - share) * a.position - share * b.position;
    // The course differs from north by less than a degree: angles near 0 or 2 pi.
    const double turn = std::remainder(b.heading - a.heading, 2.0 * kPi);
    const double heading = a.heading + share * turn;
    const double right = from.x() * std::cos(heading) - from.y() * std::sin(heading);
    const double forward = from.x() * std::sin(heading) + from.y() * std::cos(heading);
    pulses.push_back({point, Eigen::Vector3d(right, forward, from.z()).normalized()});
  }
  return pulses;
}

double degreesFromVertical(const Eigen::Vector3d& beam) {
  return std::atan2(std::hypot(beam.x(), beam.y()), -beam.z()) / kRadiansPerDegree;
}

TEST(Scanners, PolygonSweepsToTheRightOnly) {
  const auto pulses = pulsesOf(Simulator(over("polygon")));
  ASSERT_NEAR(static_cast<double>(pulses.size()), 58963.0, 2.0);
  for (std::size_t i = 1; i < pulses.size(); ++i) {
    ASSERT_NE(pulses[i].point.flags & 16, 0);
    ASSERT_NEAR(pulses[i].beam.y(), 0.0, 1e-6);
    const bool turned = (pulses[i - 1].point.flags & 32) != 0;
    ASSERT_EQ(pulses[i].beam.x() < pulses[i - 1].beam.x(), turned) << i;
  }
}

TEST(Scanners, ConicalPulsesLieOnAConeAndTurnClockwise) {
  const auto pulses = pulsesOf(Simulator(over("conical")));
  double turned = 0.0;
  for (std::size_t i = 1; i < pulses.size(); ++i) {
    ASSERT_NEAR(degreesFromVertical(pulses[i].beam), 20.0, 1e-5);
    const auto azimuth = [&](std::size_t k) {
      return std::atan2(pulses[k].beam.x(), pulses[k].beam.y());
    };
    const double step = std::remainder(azimuth(i) - azimuth(i - 1), 2.0 * kPi);
    ASSERT_GT(step, 0.0);
    turned += step;
    // Towards the right on the arc ahead.
    if (std::abs(pulses[i].beam.y()) > 0.01) {
      ASSERT_EQ(pulses[i].beam.y() > 0.0, (pulses[i].point.flags & 16) != 0);
    }
  }
  // 60 m/s sqrt(1 / (2 pi)) = 23.937 revolutions a second for 150 m / (60 m/s) = 2.5 s.
  EXPECT_NEAR(turned / (2.0 * kPi), 59.84, 0.02);
}

TEST(Scanners, RosettePetalsPassTheAxisAndReachTheEdge) {
  const auto pulses = pulsesOf(Simulator(over("rosette")));
  int petals = 0;
  double largest = 0.0, smallest = 90.0;
  std::set<int> azimuths;  // of the tips, in tens of degrees
  for (std::size_t i = 1; i + 1 < pulses.size(); ++i) {
    const double angle = degreesFromVertical(pulses[i].beam);
    largest = std::max(largest, angle);
    smallest = std::min(smallest, angle);
    if (angle <= degreesFromVertical(pulses[i - 1].beam) ||
        angle <= degreesFromVertical(pulses[i + 1].beam))
      continue;
    ++petals;
    azimuths.insert(static_cast<int>(
        std::floor(std::atan2(pulses[i].beam.x(), pulses[i].beam.y()) / kRadiansPerDegree / 10)));
  }
  EXPECT_NEAR(largest, 20.0, 1e-3);
  EXPECT_LT(smallest, 0.1);
  EXPECT_NEAR(petals, 150, 1);  // sqrt(1 pulse/m2) 60 m/s = 60 petals a second for 2.5 s
  EXPECT_EQ(azimuths.size(), 36U) << "the petals turn";
}

TEST(Scanners, DualChannelsLookAheadAndBack) {
  const Simulator simulator(over("dual"));
  const auto pulses = pulsesOf(simulator);
  ASSERT_NEAR(static_cast<double>(pulses.size()), 2.0 * 58963.0, 4.0);
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    const Eigen::Vector3d& beam = pulses[i].beam;
    ASSERT_EQ(pulses[i].point.channel, i % 2);
    // A plane tilted by 10 degrees: tan 10 = 0.176327, so 95.217 m ahead at 540 m below.
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    ASSERT_NEAR(beam.y() / -beam.z(), sign * 0.1763270, 1e-6);
    ASSERT_LE(std::abs(beam.x()), std::sin(20.0001 * kRadiansPerDegree));
  }
}

TEST(Scanners, CrossChannelsMeasureCrossingLines) {
  for (const Pulse& pulse : pulsesOf(Simulator(over("cross")))) {
    // Turned counter-clockwise by 14 degrees the line runs to the front on the right.
    const double sign = pulse.point.channel == 0 ? 1.0 : -1.0;
    ASSERT_NEAR(pulse.beam.y(), sign * 0.2493280 * pulse.beam.x(), 1e-6);  // tan 14
  }
}

TEST(Scanners, MultiChannelBeamsLieOnConesAboutTheFlightDirection) {
  std::map<int, int> count;
  double last = 0.0;
  for (const Pulse& pulse : pulsesOf(Simulator(over("multi:4")))) {
    // Channels at -15, -5, 5 and 15 degrees from the plane across the flight.
    const double along = -15.0 + 10.0 * pulse.point.channel;
    ASSERT_NEAR(std::asin(pulse.beam.y()) / kRadiansPerDegree, along, 1e-5);
    ASSERT_GE(pulse.point.time, last);
    last = pulse.point.time;
    ++count[pulse.point.channel];
  }
  ASSERT_EQ(count.size(), 4U);
  for (const auto& [channel, pulses] : count) EXPECT_NEAR(pulses, 58963.0, 2.0) << channel;
}

TEST(Scanners, MultiChannelPulsesPauseOutsideTheFieldOfView) {
  const auto pulses = pulsesOf(Simulator(over("multi:4")));
  double longest = 0.0;
  for (std::size_t i = 1; i < pulses.size(); ++i)
    longest = std::max(longest, pulses[i].point.time - pulses[i - 1].point.time);
  // 60 revolutions a second, 320 of 360 degrees of which are outside.
  EXPECT_NEAR(longest, 320.0 / 360.0 / 60.0, 1e-4);
}

TEST(Scanners, EveryScannerReachesTheSwath) {
  for (const char* scanner :
       {"oscillating", "polygon", "conical", "rosette", "dual", "cross", "multi"}) {
    double left = 0.0, right = 0.0;
    for (const Pulse& pulse : pulsesOf(Simulator(over(scanner)))) {
      left = std::min(left, pulse.beam.x() / -pulse.beam.z());
      right = std::max(right, pulse.beam.x() / -pulse.beam.z());
    }
    // tan 20 = 0.36397; the plane of dual is tilted by 10, that of cross turned by 14 degrees.
    EXPECT_NEAR(right, 0.364, 0.015) << scanner;
    EXPECT_NEAR(left, -0.364, 0.015) << scanner;
  }
}

TEST(Scanners, AnUnknownScannerIsNamed) {
  ScannerOptions scanner;
  EXPECT_THROW(scanner.setType("flash"), UsageError);
  EXPECT_THROW(scanner.setType("multi:1"), UsageError);
  EXPECT_THROW(scanner.setType("multi:x"), UsageError);
  EXPECT_THROW(scanner.setType("dual:3"), UsageError);
  scanner.setType("multi:32");
  EXPECT_EQ(scanner.channels, 32);
}

TEST(Scanners, ALineIntoTheMountainsIsRefused) {
  auto options = SimulationOptions::preset("mountain", 1.0, 0.02);
  options.lines[0].height = 50.0;
  EXPECT_THROW(Simulator simulator(options), UsageError);
}

TEST(Scanners, MountainsHideNothingBehindTheFirstSurface) {
  auto options = SimulationOptions::preset("mountain", 0.4, 0.02);
  options.scene.buildings = options.scene.trees = 0.0;
  const Simulator simulator(options);
  const Terrain& terrain = simulator.scene().terrain();
  EXPECT_GT(terrain.highest() - terrain.lowest(), 250.0);
  EXPECT_LT(terrain.highest(), options.lines[0].height - 200.0);
  const auto track = simulator.trueTrajectory();
  const auto points = simulator.strip(0);
  for (std::size_t i = 0; i < points.size(); i += 37) {
    const auto sample =
        std::lower_bound(track.begin(), track.end(), points[i].time,
                         [](const TrajectorySample& s, double time) { return s.time < time; });
    const Eigen::Vector3d ground = points[i].surface - options.origin;
    const Eigen::Vector3d sensor = sample->position - options.origin;
    for (double share = 0.5; share < 0.995; share += 0.005) {
      const Eigen::Vector3d place = sensor + share * (ground - sensor);
      ASSERT_GT(place.z(), terrain.height(place.x(), place.y())) << i;
    }
  }
}

}  // namespace
