// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/time_reference.h>
#include <pcl_als/io/time_scale.h>

#include "test_files.h"

namespace pcl_als {
namespace {

constexpr TimeKind kWeek = TimeKind::week_seconds, kAdjusted = TimeKind::adjusted_standard;

// Wednesday of GPS week 2139.
constexpr double kGps = 2139 * 604800.0 + 230038.0;
constexpr double kAdjustedTime = kGps - 1e9;

TimeRange around(double time, double before, double after) {
  return {time - before, time + after};
}

TEST(TimeReference, EqualScalesNeedNothing) {
  const TimeAlignment week =
      reconcileTimes("a.las", around(230038, 5, 5), kWeek, around(230038, 100, 100));
  EXPECT_TRUE(week.remark.empty());
  EXPECT_EQ(week(230038.25), 230038.25);
  const TimeAlignment adjusted = reconcileTimes("a.las", around(kAdjustedTime, 5, 5), kAdjusted,
                                                around(kAdjustedTime, 100, 100));
  EXPECT_TRUE(adjusted.identity());
}

TEST(TimeReference, FindsTheWeekOfAdjustedPointsForAWeekTrajectory) {
  const TimeAlignment alignment =
      reconcileTimes("a.las", around(kAdjustedTime, 5, 5), kAdjusted, around(230038, 100, 100));
  EXPECT_EQ(alignment(kAdjustedTime + 0.5), 230038.5);
  EXPECT_NE(alignment.remark.find("GPS week 2139"), std::string::npos) << alignment.remark;
}

TEST(TimeReference, FindsTheWeekOfPointsForAnAbsoluteTrajectory) {
  const TimeRange points = around(230038, 5, 5);
  const TimeAlignment to_gps = reconcileTimes("a.las", points, kWeek, around(kGps, 100, 100));
  EXPECT_EQ(to_gps(230038.5), kGps + 0.5);
  const TimeAlignment to_adjusted =
      reconcileTimes("a.las", points, kWeek, around(kAdjustedTime, 100, 100));
  EXPECT_EQ(to_adjusted(230038.5), kAdjustedTime + 0.5);
}

TEST(TimeReference, AdjustedPointsMatchATrajectoryInGpsSeconds) {
  const TimeAlignment alignment =
      reconcileTimes("a.las", around(kAdjustedTime, 5, 5), kAdjusted, around(kGps, 100, 100));
  EXPECT_EQ(alignment.offset, 1e9);
}

TEST(TimeReference, ValuesOverruleAHeaderThatLies) {
  const TimeAlignment alignment =
      reconcileTimes("a.las", around(kAdjustedTime, 5, 5), kWeek, around(230038, 100, 100));
  EXPECT_EQ(alignment(kAdjustedTime), 230038.0);
  const TimeAlignment other =
      reconcileTimes("a.las", around(230038, 5, 5), kAdjusted, around(kGps, 100, 100));
  EXPECT_EQ(other(230038.0), kGps);
}

TEST(TimeReference, AGivenWeekIsTaken) {
  const TimeRange points = around(230038, 5, 5);
  EXPECT_EQ(reconcileTimes("a.las", points, kWeek, around(kGps, 100, 100), 2139)(0.0),
            2139 * 604800.0);
  EXPECT_THROW(reconcileTimes("a.las", points, kWeek, around(kGps, 100, 100), 2138), InputError);
}

TEST(TimeReference, StripAfterTheEndOfTheWeekMatchesATrajectoryThatRunsOn) {
  const TimeRange trajectory{603000.0, 606000.0};
  EXPECT_EQ(reconcileTimes("a.las", {604700.0, 604790.0}, kWeek, trajectory)(604700.0), 604700.0);
  EXPECT_EQ(reconcileTimes("a.las", {100.0, 190.0}, kWeek, trajectory)(100.0), 604900.0);
}

TEST(TimeReference, AFileAcrossTheEndOfTheWeekIsUnwrappedPointByPoint) {
  for (const double start : {602000.0, 603000.0, 604000.0}) {
    const TimeAlignment alignment =
        reconcileTimes("a.las", {2.0, 604798.0}, kWeek, {start, start + 3000.0});
    EXPECT_EQ(alignment(604798.0), 604798.0) << start;
    EXPECT_EQ(alignment(2.0), 604802.0) << start;
  }
  const TimeAlignment absolute = reconcileTimes(
      "a.las", {2.0, 604798.0}, kWeek, {2140 * 604800.0 - 1000.0, 2140 * 604800.0 + 1000.0});
  EXPECT_EQ(absolute(604798.0), 2140 * 604800.0 - 2.0);
  EXPECT_EQ(absolute(2.0), 2140 * 604800.0 + 2.0);
}

// 2025-08-25 00:00 UTC: day 20325 of Unix time, Monday of GPS week 2381, in which day it is day 1.
constexpr double kUnix = 20325 * 86400.0;

TEST(TimeReference, UnixTimeIsBroughtToTheScaleOfTheTrajectory) {
  const TimeRange points = around(kUnix + 1000.0, 5, 5);
  const TimeAlignment week =
      reconcileTimes("a.las", points, kWeek, around(86400.0 + 1018.0, 100, 100));
  EXPECT_EQ(week(kUnix + 1000.0), 86400.0 + 1018.0);
  EXPECT_NE(week.remark.find("Unix time"), std::string::npos) << week.remark;
  EXPECT_NE(week.remark.find("GPS week 2381"), std::string::npos) << week.remark;
  const double gps = kUnix + 1000.0 - 315964800.0 + 18.0;
  EXPECT_EQ(reconcileTimes("a.las", points, kWeek, around(gps, 100, 100))(kUnix + 1000.0), gps);
  EXPECT_TRUE(reconcileTimes("a.las", points, kAdjusted, points).identity());
  // Points of the week, a trajectory in Unix time.
  EXPECT_EQ(reconcileTimes("a.las", around(86400.0, 5, 5), kWeek,
                           around(kUnix - 18.0, 100, 100))(86400.0),
            kUnix - 18.0);
}

TEST(TimeReference, UnixTimesOfOlderFlightsAreTried) {
  // 2013-09-21: GPS seconds of this value would be those of 2023.
  const double unix_time = 15969 * 86400.0 + 72007.0;
  const TimeAlignment alignment = reconcileTimes("a.las", around(unix_time, 5, 5), kWeek,
                                                 around(6 * 86400.0 + 72023.0, 100, 100));
  EXPECT_EQ(alignment(unix_time), 6 * 86400.0 + 72023.0);
}

TEST(TimeReference, RefusalsNameUnixTimeAndNoInventedWeek) {
  const std::string text = test::messageOf<InputError>([] {
    reconcileTimes("a.las", around(kUnix, 5, 5), kWeek, {230000.0, 231000.0});
  });
  EXPECT_NE(text.find("Unix time (2025-08-25)"), std::string::npos) << text;
  // A time that no week has is not brought to the week of the trajectory.
  EXPECT_THROW(reconcileTimes("a.las", around(1e15, 5, 5), kWeek, {0.0, 604800.0}), InputError);
}

TEST(TimeReference, RecordedUnitsBecomeSeconds) {
  EXPECT_EQ(secondsOfTime(1756080000.0), 1756080000.0);
  EXPECT_EQ(secondsOfTime(1756080000250.0), 1756080000.25);
  EXPECT_EQ(secondsOfTime(1756080000250000.0), 1756080000.25);
  EXPECT_NEAR(secondsOfTime(1756080000.25e9), 1756080000.25, 3e-7);
  for (const double other : {0.0, -5.0, 604800.0, 4.1e8, 1e11, 1e20})
    EXPECT_EQ(secondsOfTime(other), other);
  EXPECT_TRUE(std::isnan(secondsOfTime(std::nan(""))));
  TimeAlignment alignment;
  alignment.offset = -1756080000.0;
  EXPECT_EQ(alignment(1756080000250.0), 0.25);  // every use of a time with a trajectory
  EXPECT_NE(unixTimeText({kUnix, kUnix + 5.0}, 1e9)
                .find("Unix time in nanoseconds (2025-08-25): GPS time is Unix time - 315964800 + "
                      "18 s"),
            std::string::npos);
}

TEST(TimeReference, FindsTheEndOfAWeekInsideAFlight) {
  const auto rollover = weekRollover({{2.0, 60.0}, {604700.0, 604799.0}});
  ASSERT_TRUE(rollover);
  EXPECT_GT(*rollover, 60.0);
  EXPECT_LT(*rollover, 604700.0);
  // Flights of Sunday and Saturday; absolute times; a flight inside a week.
  EXPECT_FALSE(weekRollover({{30000.0, 33000.0}, {560000.0, 570000.0}}));
  EXPECT_FALSE(weekRollover({{4e8, 4e8 + 10.0}, {4e8 + 604000.0, 4e8 + 604100.0}}));
  EXPECT_FALSE(weekRollover({{200000.0, 200100.0}, {200300.0, 200400.0}}));
  EXPECT_FALSE(weekRollover({}));
}

TEST(TimeReference, RangesThatDoNotMeetAreBothGiven) {
  try {
    reconcileTimes("strip7.las", {1000.0, 1010.5}, kWeek, {230000.0, 231000.0});
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"strip7.las", "1000.000", "1010.500", "230000.000", "231000.000"}) {
      EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
}

TEST(TimeReference, PointsWithoutTimesAreRefused) {
  const TimeRange trajectory{0.0, 1000.0};
  EXPECT_THROW(reconcileTimes("a.las", {0.0, 0.0}, kWeek, trajectory), InputError);
  EXPECT_THROW(reconcileTimes("a.las", {0.0, 0.0}, TimeKind::none, trajectory), InputError);
  EXPECT_THROW(reconcileTimes("a.las", TimeRange(), kWeek, trajectory), InputError);
  EXPECT_THROW(reconcileTimes("a.las", {1.0, 2.0}, kWeek, TimeRange()), InputError);
}

TEST(TimeReference, RangeGrowsByAddedTimesAndIgnoresNan) {
  TimeRange range;
  EXPECT_TRUE(range.empty());
  range.add(std::nan(""));
  EXPECT_TRUE(range.empty());
  range.add(3.0);
  range.add(-1.0);
  EXPECT_EQ(range.first, -1.0);
  EXPECT_EQ(range.last, 3.0);
}

}  // namespace
}  // namespace pcl_als
