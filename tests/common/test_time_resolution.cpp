// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/time_resolution.h>

namespace pcl_als {
namespace {

/// 20,000 points of 2 s, two returns per pulse, with times rounded down to a step.
TimeResolution rounded(double step) {
  TimeResolution resolution;
  for (int i = 0; i < 20'000; ++i) {
    const double time = 400'000.0 + (i / 2) * 2e-4;
    resolution.add(step > 0.0 ? step * std::floor(time / step) : time);
  }
  return resolution;
}

TEST(TimeResolution, FindsTheStepOfRoundedTimes) {
  EXPECT_EQ(rounded(0.0).step(), 0.0);
  EXPECT_DOUBLE_EQ(rounded(1.0).step(), 1.0);
  EXPECT_DOUBLE_EQ(rounded(1.0 / 32.0).step(), 1.0 / 32.0);
  EXPECT_EQ(rounded(1e-3).step(), 0.0);  // ten points per time: could be returns of one pulse
}

// A block that is sorted by place has times of several passes: the step is that between neighbours.
TEST(TimeResolution, GapsBetweenTimesAreNoSteps) {
  TimeResolution resolution, second;
  for (int i = 0; i < 40'000; ++i) {
    const double time = std::floor((i / 10'000) * 100.0 + (i % 10'000) * 1e-3);
    (i % 2 == 0 ? resolution : second).add(time);
  }
  resolution.add(second);
  EXPECT_DOUBLE_EQ(resolution.step(), 1.0);
  EXPECT_EQ(resolution.describe(), "whole seconds (40 distinct values in 40000 points)");
  EXPECT_EQ(rounded(1.0 / 32.0).describe().rfind("steps of 0.0312 s (", 0), 0U);
  EXPECT_EQ(rounded(0.0).describe(), "");
}

TEST(TimeResolution, SaysNothingOfFewPoints) {
  TimeResolution resolution;
  for (int i = 0; i < 999; ++i) resolution.add(5.0);
  EXPECT_EQ(resolution.step(), 0.0);
  resolution.add(5.0);
  EXPECT_TRUE(std::isinf(resolution.step()));  // a single time for all points
}

}  // namespace
}  // namespace pcl_als
