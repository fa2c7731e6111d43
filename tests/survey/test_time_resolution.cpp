// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/survey/time_resolution.h>

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

TEST(TimeResolution, SaysNothingOfFewPoints) {
  TimeResolution resolution;
  for (int i = 0; i < 999; ++i) resolution.add(5.0);
  EXPECT_EQ(resolution.step(), 0.0);
  resolution.add(5.0);
  EXPECT_TRUE(std::isinf(resolution.step()));  // a single time for all points
}

}  // namespace
}  // namespace pcl_als
