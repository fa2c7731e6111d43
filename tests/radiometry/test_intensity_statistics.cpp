// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/radiometry/intensity_statistics.h>

namespace pcl_als {
namespace {

TEST(IntensityStatistics, SortsBySlopeClassAndStrip) {
  IntensityStatistics statistics(2);
  statistics.add(0, 2.0, 20.0, 4.9, 2);
  statistics.add(0, 4.0, 20.0, 3.0, 2);
  statistics.add(1, 6.0, 30.0, 5.0, 6);
  statistics.add(1, 8.0, 40.0, NAN, 5);
  statistics.add(1, 9.0, 50.0, 89.0, 6);
  // 2 and 4: mean 3, variance (n - 1) 2, ratio 2/3.
  EXPECT_NEAR(varianceToMean(statistics.slope(0).before), 2.0 / 3.0, 1e-12);
  EXPECT_EQ(varianceToMean(statistics.slope(0).after), 0.0);
  EXPECT_EQ(statistics.slope(1).before.count(), 1U);
  EXPECT_EQ(statistics.slope(IntensityStatistics::kSlopeBins).before.mean(), 8.0);
  EXPECT_EQ(statistics.slope(IntensityStatistics::kSlopeBins - 1).before.mean(), 9.0);
  EXPECT_EQ(statistics.classOf(6).before.count(), 2U);
  EXPECT_EQ(statistics.strip(0).after.mean(), 20.0);
  EXPECT_EQ(statistics.all().before.count(), 5U);
  EXPECT_EQ(varianceToMean(RunningStatistics()), 0.0);
}

TEST(IntensityStatistics, MergingIsAddingUp) {
  IntensityStatistics whole(1), first(1), second(1);
  for (int i = 0; i < 100; ++i) {
    const double value = 10.0 + i % 7, slope = i % 60;
    whole.add(0, value, 2.0 * value, slope, 2);
    (i < 40 ? first : second).add(0, value, 2.0 * value, slope, 2);
  }
  first.merge(second);
  EXPECT_EQ(first.all().before.count(), 100U);
  EXPECT_NEAR(varianceToMean(first.all().after), varianceToMean(whole.all().after), 1e-12);
  EXPECT_NEAR(first.slope(3).before.mean(), whole.slope(3).before.mean(), 1e-12);
}

}  // namespace
}  // namespace pcl_als
