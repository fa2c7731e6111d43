// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/attitude_form.h>
#include <pcl_als/trajectory/attitude_axes.h>

namespace pcl_als {
namespace {

using Samples = std::vector<TrajectorySample>;
const std::vector<double> kNoTurns;
constexpr auto kNorth = AxesByCourse::north_east_down;
constexpr auto kEast = AxesByCourse::east_north_up;
constexpr auto kUndecided = AxesByCourse::undecided;

/// Flies on for some seconds from a course to another, 50 m/s, with 4 degrees of crab.
void fly(Samples& samples, double seconds, double from, double to) {
  for (int i = 0; i < 10 * static_cast<int>(seconds); ++i) {
    const double course = (from + (to - from) * i / (10.0 * seconds)) * kRadiansPerDegree;
    TrajectorySample next;
    if (!samples.empty()) next = samples.back();
    next.time += 0.1;
    next.position += 5.0 * Eigen::Vector3d(std::sin(course), std::cos(course), 0.0);
    next.roll = 0.02, next.pitch = 0.03;
    next.heading = wholeTurn(course - 4.0 * kRadiansPerDegree);
    samples.push_back(next);
  }
}

Samples line(double course) {
  Samples samples;
  fly(samples, 20.0, course, course);
  return samples;
}

/// What a file of axes east, north, up holds, read as if they were north, east, down.
Samples readWrongly(Samples samples, AttitudeForm form) {
  for (TrajectorySample& sample : samples) takeAsEastNorthUp(sample, form, 0.0);
  return samples;
}

AxesByCourse settled(Samples& samples, AttitudeForm form) {
  return settleAxes({{form, samples, kNoTurns}}).at(0);
}

TEST(AttitudeAxes, AreThoseUnderWhichTheHeadingFollowsTheCourse) {
  for (const double course : {5.0, 100.0, 185.0, 300.0}) {
    const Samples truth = line(course);
    for (const auto form : {AttitudeForm::yaw, AttitudeForm::quaternion}) {
      Samples plain = truth, wrong = readWrongly(truth, form);
      EXPECT_EQ(settled(plain, form), kNorth) << course;
      EXPECT_EQ(plain[7].heading, truth[7].heading);
      EXPECT_EQ(plain[7].pitch, truth[7].pitch);
      EXPECT_EQ(settled(wrong, form), kEast) << course;
      for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_NEAR(wrong[i].heading, truth[i].heading, 1e-12);
        EXPECT_EQ(wrong[i].pitch, truth[i].pitch);
        EXPECT_EQ(wrong[i].roll, truth[i].roll);
      }
    }
  }
}

TEST(AttitudeAxes, OfAHeadingAreNotOpen) {
  Samples wrong = readWrongly(line(5.0), AttitudeForm::yaw);
  const double before = wrong[3].heading;
  EXPECT_EQ(settled(wrong, AttitudeForm::heading), kNorth);
  EXPECT_EQ(wrong[3].heading, before);
}

// Along north-east a heading and its complement are both near the course.
TEST(AttitudeAxes, AlongNorthEastAreDecidedByTurns) {
  Samples diagonal = line(48.0);
  EXPECT_EQ(settled(diagonal, AttitudeForm::quaternion), kUndecided);
  EXPECT_EQ(diagonal[3].pitch, 0.03);  // as it was
  // A yaw is a heading where nothing tells otherwise.
  Samples yaw = readWrongly(line(48.0), AttitudeForm::yaw);
  EXPECT_EQ(settled(yaw, AttitudeForm::yaw), kNorth);

  Samples block;
  fly(block, 40.0, 48.0, 48.0);
  fly(block, 12.0, 48.0, 228.0);
  fly(block, 40.0, 228.0, 228.0);
  for (const auto form : {AttitudeForm::yaw, AttitudeForm::quaternion}) {
    Samples plain = block, wrong = readWrongly(block, form);
    EXPECT_EQ(settled(plain, form), kNorth);
    EXPECT_EQ(settled(wrong, form), kEast);
    EXPECT_NEAR(wrong[450].heading, block[450].heading, 1e-12);
  }
}

TEST(AttitudeAxes, AreUndecidedWhereNothingFollowsTheCourse) {
  Samples sideward = line(100.0), resting = line(100.0);
  for (TrajectorySample& sample : sideward) sample.heading += 0.5 * kPi;
  for (TrajectorySample& sample : resting) sample.position.setZero();
  for (Samples* samples : {&sideward, &resting}) {
    Samples yaw = *samples;
    EXPECT_EQ(settled(*samples, AttitudeForm::quaternion), kUndecided);
    EXPECT_EQ(settled(yaw, AttitudeForm::yaw), kNorth);
  }
}

TEST(AttitudeAxes, OfFilesOfOneFormAreDecidedTogether) {
  const Samples truth = line(48.0);
  Samples diagonal = readWrongly(truth, AttitudeForm::quaternion);
  Samples north = readWrongly(line(5.0), AttitudeForm::quaternion);
  for (int k = 0; k < 3; ++k) {
    const Samples more = north;
    north.insert(north.end(), more.begin(), more.end());
  }
  Samples heading = line(5.0);
  Samples yaw = readWrongly(line(185.0), AttitudeForm::yaw);
  const auto found = settleAxes({{AttitudeForm::quaternion, diagonal, kNoTurns},
                                 {AttitudeForm::quaternion, north, kNoTurns},
                                 {AttitudeForm::heading, heading, kNoTurns},
                                 {AttitudeForm::yaw, yaw, kNoTurns}});
  EXPECT_EQ(found, (std::vector<AxesByCourse>{kEast, kEast, kNorth, kEast}));
  EXPECT_NEAR(diagonal[9].heading, truth[9].heading, 1e-12);
  EXPECT_NEAR(heading[9].heading, line(5.0)[9].heading, 1e-12);
  EXPECT_NEAR(yaw[9].heading, line(185.0)[9].heading, 1e-12);
}

// The meridian convergence was added to the yaw that was read: it stays with the heading.
TEST(AttitudeAxes, KeepWhatTheHeadingWasTurnedBy) {
  const double turn = -0.03, yaw = 1.2;
  Samples samples = line(90.0 - (yaw - turn) / kRadiansPerDegree);
  for (TrajectorySample& sample : samples) sample.heading = yaw + turn;
  const std::vector<double> turns(samples.size(), turn);
  EXPECT_EQ(settleAxes({{AttitudeForm::yaw, samples, turns}}).at(0), kEast);
  EXPECT_NEAR(samples[5].heading, 0.5 * kPi - yaw + turn, 1e-12);
}

}  // namespace
}  // namespace pcl_als
