// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/trajectory.h>

#include "flights.h"

namespace pcl_als {
namespace {

using test::circling;
using test::sampled;
using test::straight;
using Coverage = Trajectory::Coverage;

double cosKappa(const SensorPose& pose) {
  return pose.rotation(0, 0);
}
double sinKappa(const SensorPose& pose) {
  return pose.rotation(1, 0);
}

SensorPose poseOf(const Trajectory& trajectory, double time) {
  SensorPose pose;
  std::size_t cursor = 0;
  EXPECT_TRUE(trajectory.poseAt(time, pose, cursor)) << time;
  return pose;
}

std::vector<TrajectorySample> joined(std::vector<TrajectorySample> a,
                                     const std::vector<TrajectorySample>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Trajectory, KappaIsMinusHeadingForTheFourCourses) {
  const struct {
    double course, cos_kappa, sin_kappa;
  } expected[] = {{0, 1, 0}, {90, 0, -1}, {180, -1, 0}, {270, 0, 1}};
  for (const auto& row : expected) {
    const Trajectory trajectory(sampled(straight(row.course), 0.0, 10.0, 0.005));
    const SensorPose pose = poseOf(trajectory, 4.0);
    // 1e-12: rounding of coordinates of 600 m over a window of 60 m.
    EXPECT_NEAR(cosKappa(pose), row.cos_kappa, 1e-12) << row.course;
    EXPECT_NEAR(sinKappa(pose), row.sin_kappa, 1e-12) << row.course;
  }
}

TEST(Trajectory, PositionIsInterpolatedBetweenSamples) {
  const Trajectory trajectory(sampled(straight(90), 0.0, 10.0, 0.5));
  const SensorPose pose = poseOf(trajectory, 3.2);
  EXPECT_NEAR(pose.position.x(), 192.0, 1e-11);
  EXPECT_NEAR(pose.position.y(), 0.0, 1e-11);
  EXPECT_DOUBLE_EQ(pose.position.z(), 1000.0);
}

TEST(Trajectory, TwoSamplesMakeALine) {
  TrajectorySample a, b;
  a.time = 5.0;
  b.time = 7.0, b.position = {30.0, 40.0, 2.0};
  const Trajectory trajectory({a, b});
  const SensorPose pose = poseOf(trajectory, 6.0);
  EXPECT_TRUE(pose.position.isApprox(Eigen::Vector3d(15.0, 20.0, 1.0)));
  EXPECT_NEAR(cosKappa(pose), 0.8, 1e-15);  // (-sin, cos) = (0.6, 0.8)
  EXPECT_NEAR(sinKappa(pose), -0.6, 1e-15);
}

TEST(Trajectory, AccelerationAlongTheLineLeavesItsDirection) {
  const auto path = [](double t) -> Eigen::Vector3d {
    return (40.0 * t + 1.5 * t * t) * Eigen::Vector3d(0.6, 0.8, 0.0);
  };
  const SensorPose pose = poseOf(Trajectory(sampled(path, 0.0, 20.0, 0.005)), 7.1234);
  EXPECT_NEAR(cosKappa(pose), 0.8, 1e-12);
  EXPECT_NEAR(sinKappa(pose), -0.6, 1e-12);
}

TEST(Trajectory, DirectionOnACircleIsItsTangent) {
  const Trajectory trajectory(sampled(circling, 0.0, 100.0, 0.005));
  for (const double time : {0.6, 10.0, 31.4159, 77.7777}) {
    const SensorPose pose = poseOf(trajectory, time);
    const double heading = 0.02 * time;
    // By symmetry the line through a centred window is parallel to the tangent; between samples
    // 5 ms apart (1e-4 rad) the interpolation adds less than 1e-12.
    EXPECT_NEAR(cosKappa(pose), std::cos(heading), 1e-10);
    EXPECT_NEAR(sinKappa(pose), -std::sin(heading), 1e-10);
    // Sagitta of one step: 0.3^2 / (8 * 3000) m.
    EXPECT_LT((pose.position - circling(time)).norm(), 4e-6);
  }
}

TEST(Trajectory, DirectionIsAUnitVectorInASharpTurnToo) {
  const Trajectory trajectory(sampled(circling, 0.0, 100.0, 20.0));
  const SensorPose pose = poseOf(trajectory, 51.0);
  EXPECT_NEAR(std::hypot(cosKappa(pose), sinKappa(pose)), 1.0, 2e-7);  // as FlightSpan states
}

/// The fit at a sample in extended precision, straight from its definition.
Eigen::Vector2d directVelocity(const std::vector<TrajectorySample>& samples, double time,
                               double half_width) {
  long double n = 0, t = 0, x = 0, y = 0, tt = 0, tx = 0, ty = 0;
  const Eigen::Vector3d origin = samples.front().position;
  for (const TrajectorySample& s : samples) {
    if (s.time < time - half_width || s.time > time + half_width) continue;
    const long double dt = static_cast<long double>(s.time) - time;
    const long double dx = static_cast<long double>(s.position.x()) - origin.x();
    const long double dy = static_cast<long double>(s.position.y()) - origin.y();
    n += 1, t += dt, x += dx, y += dy, tt += dt * dt, tx += dt * dx, ty += dt * dy;
  }
  const long double determinant = n * tt - t * t;
  return {static_cast<double>((n * tx - t * x) / determinant),
          static_cast<double>((n * ty - t * y) / determinant)};
}

TEST(Trajectory, SlidingFitEqualsTheDirectOneAfterAnHourAtLargeCoordinates) {
  const auto path = [](double t) -> Eigen::Vector3d {
    return {583394.0 + 3000.0 * std::sin(t / 60.0), 5283100.0 + 50.0 * (t - 3e5), 498.0};
  };
  const auto samples = sampled(path, 3e5, 3e5 + 3600.0, 0.02);
  const Trajectory trajectory(samples);
  for (const std::size_t i : {0UL, 1UL, 777UL, 90001UL, samples.size() - 1}) {
    const Eigen::Vector2d v = directVelocity(samples, samples[i].time, 0.5).normalized();
    const SensorPose pose = poseOf(trajectory, samples[i].time);
    // Sums relative to an origin within the window: 1e3 m m s of sums of 50 terms, eps 1e-16.
    EXPECT_NEAR(-sinKappa(pose), v.x(), 1e-12) << i;
    EXPECT_NEAR(cosKappa(pose), v.y(), 1e-12) << i;
  }
}

TEST(Trajectory, DirectionDoesNotDependOnWhereTheFlightWas) {
  const Eigen::Vector3d shift(583394.0, 5283100.0, 498.0);
  const SensorPose near = poseOf(Trajectory(sampled(straight(33), 0.0, 60.0, 0.005)), 30.0);
  const SensorPose far = poseOf(Trajectory(sampled(straight(33, shift), 0.0, 60.0, 0.005)), 30.0);
  // Coordinates of 5e6 m are rounded to 5e-10 m; over 60 m of line, averaged.
  EXPECT_NEAR(cosKappa(near), cosKappa(far), 1e-11);
  EXPECT_NEAR(sinKappa(near), sinKappa(far), 1e-11);
}

TEST(Trajectory, NoLineIsFittedAcrossAGap) {
  const auto samples =
      joined(sampled(straight(0), 0.0, 10.0, 0.01), sampled(straight(90), 12.0, 20.0, 0.01));
  const Trajectory trajectory(samples);
  ASSERT_EQ(trajectory.gaps().size(), 1U);
  EXPECT_DOUBLE_EQ(trajectory.gaps()[0].from, 10.0);
  EXPECT_DOUBLE_EQ(trajectory.gaps()[0].to, 12.0);
  EXPECT_NEAR(cosKappa(poseOf(trajectory, 10.0)), 1.0, 1e-12);
  EXPECT_NEAR(sinKappa(poseOf(trajectory, 12.0)), -1.0, 1e-12);
  EXPECT_EQ(trajectory.coverage(10.0), Coverage::covered);
  EXPECT_EQ(trajectory.coverage(11.0), Coverage::in_gap);
  EXPECT_EQ(trajectory.coverage(12.0), Coverage::covered);
}

TEST(Trajectory, OutsideItsTimesThereIsNoLineAndNothingIsTouched) {
  const Trajectory trajectory(sampled(straight(0), 100.0, 110.0, 0.01));
  SensorPose pose;
  pose.position = Eigen::Vector3d(1.0, 2.0, 3.0);
  std::size_t cursor = 0;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double time : {99.9, 110.1, nan, infinity, -infinity}) {
    EXPECT_FALSE(trajectory.poseAt(time, pose, cursor)) << time;
  }
  EXPECT_EQ(pose.position, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(trajectory.coverage(99.9), Coverage::before_start);
  EXPECT_EQ(trajectory.coverage(110.1), Coverage::after_end);
  EXPECT_EQ(trajectory.coverage(100.0), Coverage::covered);
  EXPECT_EQ(trajectory.coverage(trajectory.endTime()), Coverage::covered);
}

TEST(Trajectory, LookUpsInAnyOrderEqualThoseInOrder) {
  std::mt19937 random(7);
  auto samples = sampled(circling, 0.0, 50.0, 0.005);
  const auto later = sampled(circling, 4000.0, 4050.0, 0.01);  // most of the duration is a gap
  samples = joined(samples, later);
  const Trajectory trajectory(samples);
  std::uniform_real_distribution<double> within(0.0, 50.0);
  std::vector<double> times;
  for (int i = 0; i < 2000; ++i) times.push_back(within(random) + (i % 2 == 0 ? 0.0 : 4000.0));
  times.insert(times.end(), {0.0, 50.0, 4000.0, trajectory.endTime()});
  std::size_t cursor = 0;
  for (const double time : times) {
    SensorPose pose;
    ASSERT_TRUE(trajectory.poseAt(time, pose, cursor)) << time;
    const SensorPose fresh = poseOf(trajectory, time);
    EXPECT_EQ(pose.position, fresh.position);
    EXPECT_EQ(cosKappa(pose), cosKappa(fresh));
    EXPECT_LT((pose.position - circling(time)).norm(), 2e-5);  // sagitta of a 0.6 m step
  }
}

TEST(Trajectory, ASpanHoldsItsTime) {
  const Trajectory trajectory(sampled(circling, 0.0, 50.0, 0.5));
  FlightSpan span;
  std::size_t cursor = 0;
  ASSERT_TRUE(trajectory.spanAt(17.3, span, cursor));  // turns by 0.01 rad: in two parts at most
  EXPECT_LE(span.from, 17.3);
  EXPECT_GE(span.from, 17.0);
  EXPECT_EQ(span.to, 17.5);
  EXPECT_LT((span.at(17.5).position - circling(17.5)).norm(), 1e-11);
}

TEST(Trajectory, ThePathAloneIsThatOfThePoses) {
  const Trajectory trajectory(
      joined(sampled(circling, 0.0, 20.0, 0.5), sampled(circling, 30.0, 50.0, 0.5)));
  PathSpan span;
  std::size_t cursor = 0;
  EXPECT_FALSE(span.holds(0.0));
  for (const double time : {0.0, 3.14, 17.3, 20.0, 30.0, 49.9, 50.0}) {
    ASSERT_TRUE(trajectory.pathAt(time, span, cursor)) << time;
    // Coordinates of 5.7e6 m: a double's step is 9e-10 m.
    EXPECT_LT((span.at(time) - poseOf(trajectory, time).position).norm(), 3e-9) << time;
  }
  for (const double time : {-0.1, 25.0, 50.1, static_cast<double>(NAN)})
    EXPECT_FALSE(trajectory.pathAt(time, span, cursor)) << time;
}

TEST(Trajectory, UnsortedSamplesAreSortedAndReported) {
  auto samples = sampled(circling, 0.0, 20.0, 0.1);
  const Trajectory sorted(samples);
  std::shuffle(samples.begin(), samples.end(), std::mt19937(3));
  const Trajectory trajectory(samples);
  EXPECT_EQ(poseOf(trajectory, 3.14).position, poseOf(sorted, 3.14).position);
  EXPECT_TRUE(sorted.repairs().empty());
  ASSERT_EQ(trajectory.repairs().size(), 1U);
  EXPECT_NE(trajectory.repairs()[0].find("sorted"), std::string::npos);
}

TEST(Trajectory, SamplesOfOneTimeBecomeTheirMean) {
  auto samples = sampled(straight(0), 0.0, 2.0, 0.5);
  samples.push_back(samples[2]);
  samples.push_back(samples[2]);
  samples.back().position.z() += 0.3;
  const Trajectory trajectory(samples);
  EXPECT_EQ(trajectory.size(), 5U);
  EXPECT_NEAR(poseOf(trajectory, 1.0).position.z(), 1000.1, 1e-9);
  EXPECT_EQ(trajectory.repairs().size(), 2U);  // unsorted, repeated
}

TEST(Trajectory, SamplesOfOneTimeFarApartAreRefused) {
  auto samples = sampled(straight(0), 0.0, 2.0, 0.5);
  samples.push_back(samples.back());
  samples.back().position.x() += 1.1;
  EXPECT_NE(Trajectory(samples).repairs().front().find("excluded"), std::string::npos);
  try {
    Trajectory::Options unscreened;
    unscreened.screen_samples = false;
    const Trajectory trajectory(samples, unscreened);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("2.000000"), std::string::npos) << error.what();
  }
}

TEST(Trajectory, ASampleAloneBetweenGapsIsExcluded) {
  auto samples = joined(sampled(straight(0), 0.0, 5.0, 0.01), sampled(straight(0), 30.0, 30.0, 1));
  samples = joined(samples, sampled(straight(0), 60.0, 65.0, 0.01));
  const Trajectory trajectory(samples);
  ASSERT_EQ(trajectory.gaps().size(), 1U);
  EXPECT_EQ(trajectory.coverage(30.0), Coverage::in_gap);
  EXPECT_EQ(trajectory.repairs().size(), 1U);
}

TEST(Trajectory, AWindowWithOneSampleTakesItsNeighbours) {
  const Trajectory trajectory(sampled(circling, 0.0, 50.0, 2.0));
  // Three samples, symmetric: the tangent again.
  EXPECT_NEAR(sinKappa(poseOf(trajectory, 20.0)), -std::sin(0.4), 1e-12);
  // Two at the end: the chord, whose direction is that of the middle of the step.
  EXPECT_NEAR(sinKappa(poseOf(trajectory, 50.0)), -std::sin(0.02 * 49.0), 2e-7);
}

TEST(Trajectory, StandingBeforeTakeOffTakesTheFirstDirection) {
  const auto path = [](double t) -> Eigen::Vector3d {
    return {t < 10.0 ? 0.0 : 50.0 * (t - 10.0), 0.0, 0.0};
  };
  const Trajectory trajectory(sampled(path, 0.0, 20.0, 0.1));
  EXPECT_NEAR(sinKappa(poseOf(trajectory, 2.0)), -1.0, 1e-12);
  EXPECT_EQ(trajectory.repairs().size(), 1U);
}

TEST(Trajectory, RefusesWhatHasNoLine) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Trajectory(std::vector<TrajectorySample>{}), InputError);
  EXPECT_THROW(Trajectory(std::vector<TrajectorySample>(3)), InputError);  // one time
  EXPECT_THROW(Trajectory(sampled(straight(0), 1.0, 1.0, 1.0)), InputError);
  const auto climb = [](double t) -> Eigen::Vector3d { return {5.0, 5.0, t}; };
  EXPECT_THROW(Trajectory(sampled(climb, 0.0, 10.0, 0.1)), InputError);
  auto samples = sampled(straight(0), 0.0, 10.0, 0.1);
  samples[7].position.y() = nan;
  EXPECT_THROW(Trajectory{samples}, InputError);
  samples = sampled(straight(0), 0.0, 10.0, 0.1);
  samples[7].time = nan;
  EXPECT_THROW(Trajectory{samples}, InputError);
  samples[7].time = 1e300;
  EXPECT_THROW(Trajectory{samples}, InputError);
}

TEST(Trajectory, RefusesImpossibleOptions) {
  const auto samples = sampled(straight(0), 0.0, 10.0, 0.1);
  Trajectory::Options options;
  options.line_fit_half_width = 0.0;
  EXPECT_THROW(Trajectory(samples, options), UsageError);
  options.line_fit_half_width = 0.5;
  options.gap_threshold = -1.0;
  EXPECT_THROW(Trajectory(samples, options), UsageError);
  options.gap_threshold = 0.01;  // shorter than every step
  EXPECT_THROW(Trajectory(samples, options), InputError);
}

TEST(Trajectory, KnowsWhetherAllSamplesHaveAttitude) {
  auto samples = sampled(straight(0), 0.0, 1.0, 0.1);
  EXPECT_FALSE(Trajectory(samples).samplesHaveAttitude());
  for (auto& sample : samples) sample.roll = sample.pitch = sample.heading = 0.0;
  EXPECT_TRUE(Trajectory(samples).samplesHaveAttitude());
  EXPECT_FALSE(Trajectory(samples).hasAttitude());  // not used unless asked for
}

}  // namespace
}  // namespace pcl_als
