// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/time_reference.h>

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
