// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "flights.h"

namespace pcl_als {
namespace {

using test::sampled;
using test::straight;

Eigen::Matrix3d turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// X = X0 + R (P + B u) of Eq. (1), written out by itself; \a p are the whole parameters.
Eigen::Vector3d equation1(const SensorPose& pose, double range, double encoder,
                          const SystemVector& p) {
  const Eigen::Matrix3d boresight = turn(p[5], Eigen::Vector3d::UnitZ()) *
                                    turn(p[3], Eigen::Vector3d::UnitX()) *
                                    turn(p[4], Eigen::Vector3d::UnitY());
  const double beta = (1.0 + p[7]) * encoder;
  const Eigen::Vector3d beam(-std::sin(beta), 0.0, -std::cos(beta));
  return pose.position + pose.rotation * (p.head<3>() + boresight * ((range + p[6]) * beam));
}

SensorPose tilted() {
  SensorPose pose;
  pose.position = Eigen::Vector3d(400.0, -300.0, 1200.0);
  pose.rotation = groundFromBody(0.05, -0.03, 2.1).toRotationMatrix();
  pose.has_attitude = true;
  return pose;
}

SystemVector scaledBiases(double factor) {
  SystemVector values;
  values << 1.0, -0.8, 0.5, 8.7e-3, -8.7e-3, 6e-3, 1.0, 4e-3;
  return factor * values;
}

TEST(Attitude, RotationFollowsItsSigns) {
  // Heading east, level: right is south, forward east.
  EXPECT_TRUE((groundFromBody(0.0, 0.0, kPi / 2.0) * Eigen::Vector3d::UnitY())
                  .isApprox(Eigen::Vector3d::UnitX()));
  // Nose up: forward gains height. Right wing down: right loses it.
  EXPECT_NEAR((groundFromBody(0.0, 0.1, 1.0) * Eigen::Vector3d::UnitY()).z(), std::sin(0.1), 1e-15);
  EXPECT_NEAR((groundFromBody(0.1, 0.0, 1.0) * Eigen::Vector3d::UnitX()).z(), -std::sin(0.1),
              1e-15);
}

TEST(Attitude, CorrectedUndoesEquation1ForLargeBiases) {
  const SensorPose pose = tilted();
  for (const double encoder : {-0.6, -0.1, 0.0, 0.35}) {
    const Eigen::Vector3d truth = equation1(pose, 1100.0, encoder, SystemVector::Zero());
    const Eigen::Vector3d biased = equation1(pose, 1100.0, encoder, scaledBiases(1.0));
    ASSERT_GT((biased - truth).norm(), 5.0);
    EXPECT_LT((corrected(pose, biased, scaledBiases(1.0)) - truth).norm(), 1e-9);
  }
}

TEST(Attitude, DesignEqualsCentralDifferencesOfEquation1) {
  const SensorPose pose = tilted();
  for (const double encoder : {-0.4, 0.0, 0.3}) {
    const Eigen::Vector3d point = equation1(pose, 1300.0, encoder, SystemVector::Zero());
    const DesignBlock design = designBlock(scanGeometry(pose, point));
    for (int i = 0; i < kSystemParameterCount; ++i) {
      const SystemVector step = 1e-4 * SystemVector::Unit(i);
      const Eigen::Vector3d difference =
          (equation1(pose, 1300.0, encoder, step) - equation1(pose, 1300.0, encoder, -step)) / 2e-4;
      // Rounding 1e3 m * 2e-16 / 1e-4; truncation r step^2 / 6.
      EXPECT_LT((design.col(i) - difference).norm(), 5e-6) << i << ' ' << encoder;
    }
  }
}

/// Rolling, pitching and yawing flight north, sampled at a rate.
std::vector<TrajectorySample> restless(double step) {
  auto samples = sampled(straight(0), 0.0, 20.0, step);
  for (TrajectorySample& s : samples) {
    s.roll = 0.05 * std::sin(1.1 * s.time);
    s.pitch = 0.02 + 0.03 * std::sin(0.7 * s.time);
    s.heading = 0.08 * std::cos(0.5 * s.time);
  }
  return samples;
}

Trajectory::Options attitudeUsed() {
  Trajectory::Options options;
  options.use_attitude = true;
  return options;
}

TEST(Attitude, IsInterpolatedBetweenSamples) {
  const Trajectory fine(restless(0.005), attitudeUsed()), coarse(restless(0.5), attitudeUsed());
  ASSERT_TRUE(fine.hasAttitude());
  std::size_t cursor = 0, other = 0;
  for (double time = 1.0; time < 19.0; time += 0.317) {
    SensorPose pose, sparse;
    ASSERT_TRUE(fine.poseAt(time, pose, cursor));
    const Eigen::Matrix3d truth =
        groundFromBody(0.05 * std::sin(1.1 * time), 0.02 + 0.03 * std::sin(0.7 * time),
                       0.08 * std::cos(0.5 * time))
            .toRotationMatrix();
    // Curvature 0.06 rad/s2 over (5 ms)^2 / 8.
    EXPECT_LT((pose.rotation - truth).norm(), 5e-7) << time;
    // Half-second steps turn by 0.03 rad, in several parts: 0.06 (0.5 s)^2 / 8.
    ASSERT_TRUE(coarse.poseAt(time, sparse, other));
    EXPECT_LT((sparse.rotation - truth).norm(), 4e-3) << time;
    EXPECT_LT((sparse.rotation.transpose() * sparse.rotation - Eigen::Matrix3d::Identity()).norm(),
              1e-6);
    FlightSpan span;
    ASSERT_TRUE(coarse.spanAt(time, span, other));
    EXPECT_LE(span.from, time);
    EXPECT_GE(span.to, time);
    EXPECT_LT((span.at(time).rotation - sparse.rotation).norm(), 3e-7) << time;
  }
}

TEST(Attitude, PartsOfASpanMeet) {
  const Trajectory coarse(restless(0.5), attitudeUsed());
  std::size_t cursor = 0;
  FlightSpan span, next;
  ASSERT_TRUE(coarse.spanAt(3.51, span, cursor));
  ASSERT_LT(span.to, 4.0);
  ASSERT_TRUE(coarse.spanAt(span.to + 1e-9, next, cursor));
  EXPECT_DOUBLE_EQ(next.from, span.to);
  EXPECT_LT((span.at(span.to).rotation - next.rotation).norm(), 3e-7);  // kLargestTurn^3 / 6
  EXPECT_LT((span.at(span.to).position - next.position).norm(), 1e-9);
}

TEST(Attitude, NeedsItInEverySample) {
  auto samples = restless(0.1);
  samples[7].pitch = std::nan("");
  EXPECT_FALSE(Trajectory(samples).samplesHaveAttitude());
  EXPECT_THROW(Trajectory(samples, attitudeUsed()), InputError);
}

struct Pulse {
  double time;
  Eigen::Vector3d point;
};

/// What a linear scanner measures in restless flight: 2 cm of noise across the ground, relief.
std::vector<Pulse> pulses(const Trajectory& flight, double out_of_plane) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  std::uniform_real_distribution<double> angle(-0.35, 0.35), height(0.0, 60.0);
  std::vector<Pulse> result;
  std::size_t cursor = 0;
  for (double time = 0.0; time < 20.0; time += 0.0005) {
    SensorPose pose;
    if (!flight.poseAt(time, pose, cursor)) continue;
    const double beta = angle(random);
    const Eigen::Vector3d beam =
        pose.rotation *
        Eigen::Vector3d(-std::sin(beta), out_of_plane * std::cos(40.0 * beta), -std::cos(beta));
    const double range = (pose.position.z() - height(random)) / -beam.z();
    result.push_back({time, pose.position + range * beam +
                                Eigen::Vector3d(noise(random), noise(random), noise(random))});
  }
  return result;
}

TEST(AttitudeRecovery, FindsPitchAndCrab) {
  const Trajectory truth(restless(0.005), attitudeUsed());
  const auto flight = std::make_shared<const Trajectory>(restless(0.005));
  AttitudeRecovery even(flight), odd(flight);
  std::size_t count = 0;
  for (const Pulse& pulse : pulses(truth, 0.0)) {
    (count++ % 2 == 0 ? even : odd).add(pulse.time, pulse.point);
  }
  even.merge(odd);
  const AttitudeRecovery::Outcome outcome = even.recover();
  ASSERT_TRUE(outcome.found) << outcome.remark;
  EXPECT_LT(outcome.off_plane, 1e-3);  // 0.03 rad/s over 0.1 s / sqrt(12)
  std::size_t a = 0, b = 0, c = 0, times = 0;
  double aside = 0.0;  // squares of what turns the axis out of the line of flight
  for (double time = 0.2; time < 19.8; time += 0.137) {
    SensorPose found, exact, level;
    ASSERT_TRUE(outcome.flight->poseAt(time, found, a));
    ASSERT_TRUE(truth.poseAt(time, exact, b));
    ASSERT_TRUE(flight->poseAt(time, level, c));
    aside += (exact.rotation.col(1) - level.rotation.col(1)).squaredNorm();
    ++times;
    // The plane's normal, which roll does not move. Linear motion does not matter; what does is
    // where in the window the pulses happened to be: 0.03 rad/s * 0.1 s / sqrt(200 pulses).
    EXPECT_LT((found.rotation.col(1) - exact.rotation.col(1)).norm(), 1e-3) << time;
  }
  EXPECT_NEAR(outcome.size, std::sqrt(aside / static_cast<double>(times)), 1e-3);
}

TEST(AttitudeRecovery, LeavesAScannerWithoutAPlaneAlone) {
  const Trajectory truth(restless(0.005), attitudeUsed());
  const auto flight = std::make_shared<const Trajectory>(restless(0.005));
  AttitudeRecovery recovery(flight);
  for (const Pulse& pulse : pulses(truth, 0.1)) recovery.add(pulse.time, pulse.point);
  const AttitudeRecovery::Outcome outcome = recovery.recover();
  EXPECT_FALSE(outcome.found);
  EXPECT_EQ(outcome.flight, flight);
  EXPECT_NE(outcome.remark.find("no linear scanner"), std::string::npos) << outcome.remark;
}

TEST(AttitudeRecovery, TellsTheRangeOfEachPass) {
  const Trajectory truth(restless(0.005), attitudeUsed());
  const auto flight = std::make_shared<const Trajectory>(restless(0.005));
  AttitudeRecovery recovery(flight);
  for (const Pulse& pulse : pulses(truth, 0.0)) recovery.add(pulse.time, pulse.point);
  const AttitudeRecovery::Outcome outcome = recovery.recover();
  ASSERT_EQ(outcome.passes.size(), 1U);
  EXPECT_EQ(outcome.passes[0].verdict, AttitudeRecovery::Verdict::linear);
  // restless(): pitch 0.02 +- 0.03; the percentiles cut the outermost 4 %, roll tilts the plane.
  EXPECT_NEAR(outcome.passes[0].pitch.high, 0.05, 3e-3);
  EXPECT_NEAR(outcome.passes[0].pitch.low, -0.01, 3e-3);
}

/// Where only a few points of a second were kept, the angles are those of the seconds around it.
TEST(AttitudeRecovery, BridgesTimesWithFewPoints) {
  const Trajectory truth(restless(0.005), attitudeUsed());
  const auto flight = std::make_shared<const Trajectory>(restless(0.005));
  AttitudeRecovery recovery(flight);
  for (const Pulse& pulse : pulses(truth, 0.0)) {
    const bool sliver = pulse.time > 9.0 && pulse.time < 10.0;
    // Of one second only what lies between 300 and 310 m to the right.
    if (sliver && std::abs(pulse.point.x() - 305.0) > 5.0) continue;
    recovery.add(pulse.time, pulse.point);
  }
  const AttitudeRecovery::Outcome outcome = recovery.recover();
  ASSERT_TRUE(outcome.found) << outcome.remark;
  std::size_t a = 0, b = 0;
  for (double time = 9.05; time < 10.0; time += 0.1) {
    SensorPose found, exact;
    ASSERT_TRUE(outcome.flight->poseAt(time, found, a));
    ASSERT_TRUE(truth.poseAt(time, exact, b));
    // Half a second from good times: rates of 0.04 rad/s against a walk of 8 mrad per second.
    EXPECT_LT((found.rotation.col(1) - exact.rotation.col(1)).norm(), 0.02) << time;
  }
}

/// What a conical scanner of 18 degrees measures of a square of 100 m, or of everything: 60 m/s at
/// 1000 m to the north, level; 40 turns of the mirror per second.
std::vector<Pulse> cone(bool square) {
  std::vector<Pulse> result;
  const auto path = straight(0);
  for (double time = 0.0; time < 20.0; time += 0.0002) {
    const double turned = 2.0 * kPi * 40.0 * time, tangent = std::tan(18.0 * kRadiansPerDegree);
    const Eigen::Vector3d sensor = path(time);
    const Eigen::Vector3d point =
        sensor +
        1000.0 * Eigen::Vector3d(tangent * std::cos(turned), tangent * std::sin(turned), -1.0);
    const bool inside = point.x() > 50.0 && point.x() < 150.0 && std::abs(point.y() - 600.0) < 50.0;
    if (!square || inside) result.push_back({time, point});
  }
  return result;
}

// 2026-11: arcs of a tenth of a second passed for planes, pitch -16 to 18 and crab -39 to 54
// degrees.
TEST(AttitudeRecovery, NoticesAConicalScanner) {
  const auto flight = std::make_shared<const Trajectory>(sampled(straight(0), 0.0, 20.0, 0.1));
  for (const bool square : {false, true}) {
    AttitudeRecovery recovery(flight);
    for (const Pulse& pulse : cone(square)) recovery.add(pulse.time, pulse.point);
    const AttitudeRecovery::Outcome outcome = recovery.recover();
    EXPECT_FALSE(outcome.found) << square;
    EXPECT_FALSE(outcome.linear) << square;
    EXPECT_NE(outcome.remark.find("on a cone of 18 degrees"), std::string::npos) << outcome.remark;
  }
}

/// Planes 15 degrees ahead and back, seen one after the other by a small area.
TEST(AttitudeRecovery, NoticesSeveralPlanes) {
  const auto path = straight(0);
  const auto flight = std::make_shared<const Trajectory>(sampled(path, 0.0, 20.0, 0.1));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> across(-100.0, 100.0);
  AttitudeRecovery recovery(flight);
  for (double time = 0.0; time < 20.0; time += 0.0005) {
    for (const double ahead : {-268.0, 268.0}) {
      const Eigen::Vector3d point = path(time) + Eigen::Vector3d(across(random), ahead, -1000.0);
      if (std::abs(point.y() - 600.0) < 50.0) recovery.add(time, point);
    }
  }
  const AttitudeRecovery::Outcome outcome = recovery.recover();
  EXPECT_FALSE(outcome.linear) << outcome.remark;
  EXPECT_NE(outcome.remark.find("no linear scanner"), std::string::npos) << outcome.remark;
}

TEST(AttitudeRecovery, WithFewPointsFindsNothing) {
  const auto flight = std::make_shared<const Trajectory>(restless(0.005));
  AttitudeRecovery empty(flight), sliver(flight);
  EXPECT_FALSE(empty.recover().found);
  // One place, 300 m aside and 40 m ahead: crab or pitch, nobody knows. Until 2026-11 this counted
  // as recovered.
  for (int i = 0; i < 50; ++i) sliver.add(10.0, {300.0, 640.0, 0.0});
  const auto outcome = sliver.recover();
  EXPECT_FALSE(outcome.found);
  EXPECT_TRUE(outcome.linear);
  EXPECT_EQ(outcome.flight, flight);
}

/// Level flight, so nominal attitude is the true one: biases leave a conical scanner's points
/// entirely. Without attitude y is excluded, and they do not.
TEST(Attitude, NominalServesAConicalScanner) {
  const auto samples = sampled(straight(40), 0.0, 5.0, 0.1);
  Trajectory::Options options;
  options.nominal_attitude = true;
  const Trajectory nominal(samples, options), without(samples);
  SystemVector errors = SystemVector::Zero();
  errors << 0.0, 0.0, 0.0, 5e-4, -4e-4, 6e-4, 0.0, 0.0;
  const Eigen::Matrix3d boresight = turn(errors[5], Eigen::Vector3d::UnitZ()) *
                                    turn(errors[3], Eigen::Vector3d::UnitX()) *
                                    turn(errors[4], Eigen::Vector3d::UnitY());
  const Eigen::Matrix3d ground_from_body =
      turn(-40.0 * kRadiansPerDegree, Eigen::Vector3d::UnitZ());
  std::size_t a = 0, b = 0;
  double worst = 0.0;
  for (double turned = 0.0; turned < 6.2; turned += 0.3) {
    SensorPose pose, plain;
    ASSERT_TRUE(nominal.poseAt(2.5, pose, a));
    ASSERT_TRUE(without.poseAt(2.5, plain, b));
    const Eigen::Vector3d pulse(300.0 * std::cos(turned), 300.0 * std::sin(turned), -900.0);
    const Eigen::Vector3d truth = straight(40)(2.5) + ground_from_body * pulse;
    const Eigen::Vector3d biased = straight(40)(2.5) + ground_from_body * (boresight * pulse);
    ASSERT_GT((biased - truth).norm(), 0.1);
    EXPECT_LT((corrected(pose, biased, errors) - truth).norm(), 1e-6);
    worst = std::max(worst, (corrected(plain, biased, errors) - truth).norm());
  }
  EXPECT_GT(worst, 0.1);
}

TEST(Attitude, NominalIsLevelAlongTheCourse) {
  Trajectory::Options options;
  options.nominal_attitude = true;
  const auto samples = sampled(straight(90), 0.0, 5.0, 0.1);
  const Trajectory nominal(samples, options);
  EXPECT_TRUE(nominal.hasAttitude());
  EXPECT_TRUE(nominal.attitudeIsNominal());
  SensorPose pose;
  std::size_t cursor = 0;
  ASSERT_TRUE(nominal.poseAt(2.0, pose, cursor));
  EXPECT_TRUE(pose.has_attitude);
  EXPECT_TRUE(pose.rotation.col(1).isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  // A point ahead keeps its y, which a trajectory without attitude excludes.
  EXPECT_NEAR(scanGeometry(pose, pose.position + Eigen::Vector3d(300.0, 0.0, -900.0)).y, 300.0,
              1e-9);
  const Trajectory without = nominal.withoutAttitude();
  EXPECT_FALSE(without.hasAttitude());
  options.use_attitude = true;
  EXPECT_THROW(Trajectory(samples, options), UsageError);
}

}  // namespace
}  // namespace pcl_als
