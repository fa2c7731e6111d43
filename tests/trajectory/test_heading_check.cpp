// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/heading_check.h>

#include "flights.h"

namespace pcl_als {
namespace {

constexpr double kCheckedCourses[] = {10.0, 100.0, 190.0, 280.0};  // degrees

/// Four lines; \a value: what the column says (degrees) at a heading with 4 degrees of crab.
template <typename Value>
std::vector<TrajectorySample> lines(const Value& value) {
  std::vector<TrajectorySample> samples;
  for (const double course : kCheckedCourses) {
    auto line = test::sampled(test::straight(course), 0.0, 20.0, 0.1);
    for (TrajectorySample& sample : line) {
      sample.heading = value(course - 4.0) * kRadiansPerDegree;
      sample.time += samples.empty() ? 0.0 : 100.0;
    }
    samples.insert(samples.end(), line.begin(), line.end());
  }
  return samples;
}

TEST(HeadingCheck, AcceptsCrab) {
  const HeadingCheck check = headingCheck(lines([](double h) { return h; }));
  EXPECT_TRUE(check.followsCourse());
  EXPECT_EQ(check.best(), HeadingReading::heading);
  EXPECT_EQ(check.deviation(HeadingReading::heading), 4.0);
  EXPECT_FALSE(check.constant());
}

TEST(HeadingCheck, FindsWhatTheAngleIs) {
  const struct {
    HeadingReading reading;
    double (*value)(double heading);
  } cases[] = {
      {HeadingReading::from_east_counter_clockwise, [](double h) { return 90.0 - h; }},
      {HeadingReading::opposite, [](double h) { return h + 180.0; }},
      {HeadingReading::from_north_counter_clockwise, [](double h) { return -h; }},
      {HeadingReading::left, [](double h) { return h - 90.0; }},
      {HeadingReading::right, [](double h) { return h + 90.0; }},
      {HeadingReading::radians_as_degrees, [](double h) { return h * kRadiansPerDegree; }},
      {HeadingReading::radians_from_east_as_degrees,
       [](double h) { return (90.0 - h) * kRadiansPerDegree; }},
  };
  for (const auto& row : cases) {
    const HeadingCheck check = headingCheck(lines(row.value));
    EXPECT_FALSE(check.followsCourse()) << describe(row.reading);
    EXPECT_EQ(check.best(), row.reading) << describe(row.reading);
    // The reading gives the heading back: 4 degrees of crab, as above.
    EXPECT_EQ(check.deviation(row.reading), 4.0) << describe(row.reading);
  }
}

TEST(HeadingCheck, AColumnOfZerosIsConstant) {
  const HeadingCheck check = headingCheck(lines([](double) { return 0.0; }));
  EXPECT_TRUE(check.constant());
  EXPECT_FALSE(check.followsCourse());
}

TEST(HeadingCheck, MergedPartsAreTheWhole) {
  const auto samples = lines([](double h) { return 90.0 - h; });
  HeadingCheck parts = headingCheck({samples.begin(), samples.begin() + 300});
  parts.merge(headingCheck({samples.begin() + 299, samples.end()}));
  const HeadingCheck whole = headingCheck(samples);
  EXPECT_EQ(parts.count(), whole.count());
  EXPECT_EQ(parts.best(), whole.best());
  EXPECT_EQ(parts.lowest(), whole.lowest());
}

TEST(HeadingCheck, StandingSamplesSayNothing) {
  auto samples = test::sampled(test::straight(10.0), 0.0, 1.0, 0.1);
  for (TrajectorySample& sample : samples) {
    sample.position = Eigen::Vector3d(0.0, 0.0, 1.0);
    sample.heading = 1.0;
  }
  EXPECT_EQ(headingCheck(samples).count(), 0U);
}

}  // namespace
}  // namespace pcl_als
