// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
// Scanners whose pulses are written down as formulas, over a horizontal plane at 1000 m below.
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/scanner_detection.h>

#include "flights.h"

namespace pcl_als {
namespace {

using Eigen::Vector3d;

/// Direction (right-forward-up) of pulse number i of a channel, 10,000 pulses a second.
using Pulses = std::function<Vector3d(int i, int channel)>;

/// 10 s north with roll and pitch of a degree.
ScannerDetection filled(const Pulses& pulses, int channels, bool with_attitude) {
  auto samples = test::sampled(test::straight(0.0), 0.0, 10.0, 0.005);
  for (TrajectorySample& sample : samples) {
    sample.roll = kRadiansPerDegree * std::sin(1.1 * sample.time);
    sample.pitch = kRadiansPerDegree * std::cos(0.9 * sample.time);
    sample.heading = 0.0;
  }
  Trajectory::Options options;
  options.use_attitude = true;
  const auto flown = std::make_shared<const Trajectory>(samples, options);
  const auto given = with_attitude ? flown : std::make_shared<const Trajectory>(samples);
  ScannerDetection detection(given);
  SensorPose pose;
  std::size_t cursor = 0;
  for (int i = 0; i < 95000; ++i) {
    LidarReturn point;
    point.time = 0.1 + 1e-4 * i;
    point.channel = static_cast<std::uint8_t>(i % channels);
    EXPECT_TRUE(flown->poseAt(point.time, pose, cursor));
    const Vector3d beam = pose.rotation * pulses(i, point.channel);
    point.position = pose.position + 1000.0 / -beam.z() * beam;
    detection.add(point);
  }
  return detection;
}

DetectedScanner detected(const Pulses& pulses, int channels, bool attitude) {
  return filled(pulses, channels, attitude).assess();
}

/// Part of a sweep, 0 to 1: 50 sweeps a second.
double partOf(int i) {
  return std::fmod(i / 200.0, 1.0);
}

Vector3d inPlane(double across) {
  return {std::sin(across), 0.0, -std::cos(across)};
}

Vector3d polygonPulse(int i, int) {
  return inPlane(0.7 * (partOf(i) - 0.5));
}

Vector3d mirrorPulse(int i, int) {
  const bool back = (i / 200) % 2 == 1;
  return inPlane(0.7 * (back ? 0.5 - partOf(i) : partOf(i) - 0.5));
}

Vector3d conicalPulse(int i, int) {
  const double cone = 20.0 * kRadiansPerDegree, turn = 2.0 * kPi * partOf(i);
  return {std::sin(cone) * std::sin(turn), std::sin(cone) * std::cos(turn), -std::cos(cone)};
}

Vector3d rosettePulse(int i, int) {
  const double first = 2.0 * kPi * i / 140.0, second = -0.64 * first;
  const double right = 0.15 * (std::sin(first) + std::sin(second));
  const double forward = 0.15 * (std::cos(first) + std::cos(second));
  return Vector3d(right, forward, -1.0).normalized();
}

/// Planes tilted by +-10 degrees.
Vector3d dualPulse(int i, int channel) {
  const double tilt = (channel == 0 ? 10.0 : -10.0) * kRadiansPerDegree;
  const Vector3d beam = polygonPulse(i, 0);
  return {beam.x(), -std::sin(tilt) * beam.z(), std::cos(tilt) * beam.z()};
}

/// Planes turned by +-14 degrees.
Vector3d crossPulse(int i, int channel) {
  const double turn = (channel == 0 ? 14.0 : -14.0) * kRadiansPerDegree;
  const Vector3d beam = polygonPulse(i, 0);
  return {std::cos(turn) * beam.x(), std::sin(turn) * beam.x(), beam.z()};
}

/// Beams at -15, -5, 5 and 15 degrees.
Vector3d multiPulse(int i, int channel) {
  const double along = (-15.0 + 10.0 * channel) * kRadiansPerDegree;
  const Vector3d beam = polygonPulse(i, 0);
  return {std::cos(along) * beam.x(), std::sin(along), std::cos(along) * beam.z()};
}

TEST(ScannerDetection, WithAttitude) {
  const auto pattern = [](const Pulses& pulses, int channels) {
    return detected(pulses, channels, true).pattern;
  };
  EXPECT_EQ(pattern(mirrorPulse, 1), ScannerPattern::oscillating);
  EXPECT_EQ(pattern(polygonPulse, 1), ScannerPattern::polygon);
  EXPECT_EQ(pattern(conicalPulse, 1), ScannerPattern::conical);
  EXPECT_EQ(pattern(rosettePulse, 1), ScannerPattern::rosette);
  EXPECT_EQ(pattern(dualPulse, 2), ScannerPattern::dual_look);
  EXPECT_EQ(pattern(crossPulse, 2), ScannerPattern::crossed);
  EXPECT_EQ(pattern(multiPulse, 4), ScannerPattern::multi_channel);
}

TEST(ScannerDetection, FindsTheScanPlanes) {
  const ScannerDetection dual = filled(dualPulse, 2, true), cross = filled(crossPulse, 2, true),
                         mirror = filled(mirrorPulse, 1, true), multi = filled(multiPulse, 4, true);
  const double tilt = 10.0 * kRadiansPerDegree, turn = 14.0 * kRadiansPerDegree;
  const ScanPlanes looks = scanPlanes({&dual, &dual}), lines = scanPlanes({&cross});
  ASSERT_EQ(looks.size(), 2U);
  EXPECT_LT((looks[0] - Vector3d(0.0, std::cos(tilt), std::sin(tilt))).norm(), 1e-6);
  EXPECT_LT((looks[1] - Vector3d(0.0, std::cos(tilt), -std::sin(tilt))).norm(), 1e-6);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_LT((lines[0] - Vector3d(-std::sin(turn), std::cos(turn), 0.0)).norm(), 1e-6);
  EXPECT_LT((lines[1] - Vector3d(std::sin(turn), std::cos(turn), 0.0)).norm(), 1e-6);
  EXPECT_TRUE(scanPlanes({&mirror}).empty());  // one plane
  EXPECT_TRUE(scanPlanes({&multi}).empty());   // cones
  ByteWriter out;
  cross.put(out);
  ByteReader in(out.bytes());
  ScannerDetection received = filled(mirrorPulse, 1, true);
  received.get(in);
  EXPECT_EQ(scanPlanes({&received}), lines);
}

TEST(ScannerDetection, WithoutAttitude) {
  const auto pattern = [](const Pulses& pulses) { return detected(pulses, 1, false).pattern; };
  EXPECT_EQ(pattern(mirrorPulse), ScannerPattern::oscillating);
  EXPECT_EQ(pattern(polygonPulse), ScannerPattern::polygon);
  EXPECT_EQ(pattern(conicalPulse), ScannerPattern::conical);
  EXPECT_EQ(pattern(rosettePulse), ScannerPattern::rosette);
}

TEST(ScannerDetection, AnglesAreThoseOfTheScanner) {
  EXPECT_EQ(detected(conicalPulse, 1, true).text(), "conical, 20.0 degrees from the vertical");
  EXPECT_EQ(detected(dualPulse, 2, true).text(),
            "dual look, 2 channels, planes 20.0 degrees apart");
  EXPECT_EQ(detected(crossPulse, 2, true).text(), "crossed, 2 channels, planes 28.0 degrees apart");
  EXPECT_EQ(detected(multiPulse, 4, true).text(),
            "multi channel, 4 channels, 30.0 degrees between the outermost beams");
  // atan 0.3 = 16.7 degrees, in steps of half a degree.
  EXPECT_NEAR(detected(rosettePulse, 1, true).angle / kRadiansPerDegree, 16.7, 0.5);
}

TEST(ScannerDetection, FindsTwoChannelsThatAreNotRecorded) {
  const Pulses looks = [](int i, int) { return dualPulse(i, i % 2); };
  const Pulses lines = [](int i, int) { return crossPulse(i, i % 2); };
  const Pulses beams = [](int i, int) { return multiPulse(i, i % 4); };
  EXPECT_EQ(detected(looks, 1, true).text(), "dual look, planes 20.0 degrees apart");
  EXPECT_EQ(detected(lines, 1, true).text(), "crossed, planes 28.0 degrees apart");
  EXPECT_EQ(detected(beams, 1, true).pattern, ScannerPattern::irregular);
  const ScannerDetection one = filled(lines, 1, true), two = filled(crossPulse, 2, true),
                         cone = filled(conicalPulse, 1, true), four = filled(beams, 1, true),
                         rosette = filled(rosettePulse, 1, true);
  const ScanPlanes planes = scanPlanes({&one}), recorded = scanPlanes({&two});
  ASSERT_EQ(planes.size(), 2U);
  for (const Vector3d& normal : recorded)
    EXPECT_LT(std::min((planes[0] - normal).norm(), (planes[1] - normal).norm()), 1e-4);
  for (const ScannerDetection* other : {&cone, &four, &rosette})
    EXPECT_TRUE(scanPlanes({other}).empty());
}

TEST(ScannerDetection, FewPulsesDetermineNothing) {
  const auto flight =
      std::make_shared<const Trajectory>(test::sampled(test::straight(0.0), 0.0, 10.0, 0.005));
  EXPECT_EQ(ScannerDetection(flight).assess().pattern, ScannerPattern::undetermined);
}

}  // namespace
}  // namespace pcl_als
