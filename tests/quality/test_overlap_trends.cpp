// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/quality/pair_assessment.h>
#include <pcl_als/quality/strip_course.h>

namespace pcl_als {
namespace {

constexpr double kHeight = 800.0, kSpeed = 60.0;

/// A flight line at the height kHeight, for places on level ground.
struct Line {
  Eigen::Vector2d start, course;
  double roll = 0.0;  ///< roll error, radians

  Eigen::Vector2d right() const { return {course.y(), -course.x()}; }
  double aside(const Eigen::Vector2d& p) const { return (p - start).dot(right()); }
  double timeAt(const Eigen::Vector2d& p) const { return (p - start).dot(course) / kSpeed; }
  /// Height error of a place: the beam is turned about the line of flight, so the range is laid off
  /// at another angle, z = -range cos(angle + roll) - (-range cos(angle)).
  double heightError(const Eigen::Vector2d& p) const {
    const double angle = std::atan2(aside(p), kHeight), range = kHeight / std::cos(angle);
    // Right wing down makes what is on the right look lower than assumed level: roll assumed too
    // large lays points on the right too low.
    return -range * std::cos(angle - roll) + range * std::cos(angle);
  }
};

std::vector<OffsetSample> overlapOf(const Line& a, const Line& b, double noise = 0.0) {
  std::mt19937 random(5);
  std::normal_distribution<double> error(0.0, 1.0);
  std::vector<OffsetSample> samples;
  for (double y = -200.0; y <= 200.0; y += 8.0) {
    for (double x = -150.0; x <= 150.0; x += 8.0) {
      const Eigen::Vector2d p(x, y);
      OffsetSample s;
      s.position = Eigen::Vector3d(x, y, 100.0);
      s.vertical = a.heightError(p) - b.heightError(p) + noise * error(random);
      s.time_a = a.timeAt(p);
      s.time_b = b.timeAt(p);
      s.scan_angle_a = static_cast<float>(std::atan2(a.aside(p), kHeight) / kRadiansPerDegree);
      s.scan_angle_b = static_cast<float>(std::atan2(b.aside(p), kHeight) / kRadiansPerDegree);
      s.level = true;
      samples.push_back(s);
    }
  }
  return samples;
}

constexpr double kRoll = 90.0 * kRadiansPerArcsec;

// The signs are those of Eq. (8): dZ = -x dphi. -range cos(angle - roll) + range cos(angle) is
// -range sin(angle) roll = -x roll to first order; the second, range cos(angle) roll^2 / 2, is
// 0.08 mm here.
TEST(OverlapTrends, OppositeLinesShowTheCommonRollError) {
  const Line north{{-100.0, -500.0}, {0.0, 1.0}, kRoll}, south{{100.0, 500.0}, {0.0, -1.0}, kRoll};
  const auto trends = overlapTrends(overlapOf(north, south), north.course, south.course);
  EXPECT_EQ(trends.relation, FlightRelation::opposite);
  ASSERT_TRUE(trends.roll.determined);
  EXPECT_NEAR(trends.roll.value, kRoll, 1e-3 * kRoll);
  EXPECT_NEAR(trends.across.slope, -2.0 * kRoll, 2e-3 * kRoll);
  EXPECT_NEAR(trends.along.slope, 0.0, 1e-3 * kRoll);
  EXPECT_NEAR(trends.time.slope, 0.0, 1e-6);
  // A degree is 14 m across at 800 m: 12.2 mm of height difference.
  EXPECT_NEAR(trends.scan_angle.slope, -2.0 * kRoll * kHeight * kRadiansPerDegree, 4e-4);
  // Swapped, a flies south: what was right is left, what was a - b is b - a.
  const auto swapped = overlapTrends(overlapOf(south, north), south.course, north.course);
  EXPECT_NEAR(swapped.roll.value, kRoll, 1e-3 * kRoll);
}

TEST(OverlapTrends, ParallelLinesShowTheDifferenceAndCrossingOnesBoth) {
  const Line a{{-100.0, -500.0}, {0.0, 1.0}, kRoll}, b{{100.0, -500.0}, {0.0, 1.0}, 0.25 * kRoll};
  const auto parallel = overlapTrends(overlapOf(a, b), a.course, b.course);
  EXPECT_EQ(parallel.relation, FlightRelation::parallel);
  EXPECT_NEAR(parallel.roll.value, 0.75 * kRoll, 1e-3 * kRoll);
  const Eigen::Vector2d aslant = Eigen::Vector2d(-0.8, 0.6);
  const Line c{{400.0, -300.0}, aslant, -0.5 * kRoll};
  const auto crossing = overlapTrends(overlapOf(a, c), a.course, c.course);
  EXPECT_EQ(crossing.relation, FlightRelation::crossing);
  EXPECT_NEAR(crossing.roll.value, kRoll, 1e-3 * kRoll);
  EXPECT_NEAR(crossing.roll_b.value, -0.5 * kRoll, 1e-3 * kRoll);
}

TEST(OverlapTrends, TheStandardDeviationCoversTheNoise) {
  const Line north{{-100.0, -500.0}, {0.0, 1.0}, kRoll}, south{{100.0, 500.0}, {0.0, -1.0}, kRoll};
  const auto trends = overlapTrends(overlapOf(north, south, 0.03), north.course, south.course);
  // White noise of 3 cm at 1938 places with an RMS distance of 87.7 m across: 7.8e-6, half for
  // roll.
  EXPECT_NEAR(trends.across.std, 0.03 / (87.7 * std::sqrt(1938.0)), 2e-6);
  EXPECT_NEAR(trends.roll.std, 0.5 * trends.across.std, 1e-12);
  EXPECT_LT(std::abs(trends.roll.value - kRoll), 4.0 * trends.roll.std);
}

TEST(OverlapTrends, ProfilesHoldEveryPlaceOnce) {
  const Line north{{-100.0, -500.0}, {0.0, 1.0}, kRoll}, south{{100.0, 500.0}, {0.0, -1.0}, kRoll};
  const auto samples = overlapOf(north, south);
  const auto trends = overlapTrends(samples, north.course, south.course);
  for (const auto* bins : {&trends.by_distance, &trends.by_time, &trends.by_scan_angle}) {
    ASSERT_EQ(bins->size(), 20U);
    std::size_t count = 0;
    for (const ProfileBin& bin : *bins) count += bin.count;
    EXPECT_EQ(count, samples.size());
  }
  // The centre line is in the middle, distances count to the right: east.
  EXPECT_NEAR(trends.distance({-2.0 + 50.0, 0.0, 0.0}), 50.0, 3.0);
  EXPECT_NEAR(trends.by_distance.front().from, -149.0, 3.0);
  EXPECT_GT(trends.by_distance.front().mean, trends.by_distance.back().mean);
}

TEST(OverlapTrends, WithoutCoursesTheLongerAxisAndNoRoll) {
  const Line north{{-100.0, -500.0}, {0.0, 1.0}, kRoll}, south{{100.0, 500.0}, {0.0, -1.0}, kRoll};
  auto samples = overlapOf(north, south);
  for (OffsetSample& s : samples) s.time_a = 0.0, s.scan_angle_a = 0.0F;
  const auto trends = overlapTrends(samples, {}, {});
  EXPECT_EQ(trends.relation, FlightRelation::unknown);
  EXPECT_GT(std::abs(trends.course.y()), 0.99);
  EXPECT_FALSE(trends.roll.determined);
  EXPECT_FALSE(trends.time.determined);
  EXPECT_TRUE(trends.by_time.empty());
  EXPECT_TRUE(overlapTrends({}, {}, {}).by_distance.empty());
}

/// Points of a strip flown to the north-east with a swath of +-200 m, cut off by x < limit.
StripCourse courseOf(double limit, bool angles) {
  StripCourse course;
  const Eigen::Vector2d along = Eigen::Vector2d(0.6, 0.8), right(0.8, -0.6);
  for (int i = 0; i < 400; ++i) {
    for (int k = -20; k <= 20; ++k) {
      const Eigen::Vector2d p = 1e6 * Eigen::Vector2d::Ones() + 2.0 * i * along + 10.0 * k * right;
      if (p.x() > 1e6 + limit) continue;
      LidarReturn point;
      point.position << p, 50.0;
      point.time = 230000.0 + 2.0 * i / 60.0;
      point.scan_angle = angles ? static_cast<float>(0.5 * k) : 0.0F;
      course.add(point);
    }
  }
  return course;
}

TEST(StripCourse, IsThatOfTheFlightWhateverIsCutOff) {
  for (const double limit : {1e9, 150.0}) {
    const auto found = courseOf(limit, true).direction();
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x(), 0.6, 1e-6) << limit;
    EXPECT_NEAR(found->y(), 0.8, 1e-6) << limit;
  }
  const auto whole = courseOf(1e9, false).direction();
  ASSERT_TRUE(whole);
  EXPECT_NEAR(whole->x(), 0.6, 1e-6);
  // Without angles an oblique cut turns the course; with them (above) it does not.
  EXPECT_GT(std::abs(courseOf(150.0, false).direction()->x() - 0.6), 0.1);
}

TEST(StripCourse, SaysNothingWithoutTimes) {
  StripCourse course;
  EXPECT_FALSE(course.direction());
  for (int i = 0; i < 100; ++i) {
    LidarReturn point;
    point.position = Eigen::Vector3d(i, 2 * i, 0.0);
    course.add(point);
  }
  EXPECT_FALSE(course.direction());
}

}  // namespace
}  // namespace pcl_als
