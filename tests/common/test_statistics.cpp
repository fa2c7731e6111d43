// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/statistics.h>

namespace pcl_als {
namespace {

RunningStatistics of(const std::vector<double>& values) {
  RunningStatistics statistics;
  for (const double value : values) statistics.add(value);
  return statistics;
}

TEST(RunningStatistics, HandWorkedNumbers) {
  const RunningStatistics statistics = of({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_EQ(statistics.count(), 8U);
  EXPECT_DOUBLE_EQ(statistics.mean(), 5.0);
  EXPECT_DOUBLE_EQ(statistics.standardDeviation(), std::sqrt(32.0 / 7.0));
  EXPECT_DOUBLE_EQ(statistics.rms(), std::sqrt(232.0 / 8.0));
}

TEST(RunningStatistics, FewerThanTwoValues) {
  EXPECT_EQ(RunningStatistics().rms(), 0.0);
  EXPECT_EQ(RunningStatistics().standardDeviation(), 0.0);
  EXPECT_EQ(of({-3.0}).standardDeviation(), 0.0);
  EXPECT_EQ(of({-3.0}).rms(), 3.0);
}

TEST(RunningStatistics, LargeOffsetsDoNotHideASmallSpread) {
  // Northings: squares of 5e6 lose the centimetres of a naive sum of squares.
  EXPECT_NEAR(of({5283100.01, 5283100.02, 5283100.03}).standardDeviation(), 0.01,
              1e-8);  // doubles at 5e6 have steps of 1e-9
}

TEST(RunningStatistics, MergedPartsEqualTheWhole) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(10.0, 3.0);
  RunningStatistics whole, merged, part;
  for (int i = 0; i < 1000; ++i) {
    const double value = normal(random);
    whole.add(value);
    part.add(value);
    if (i % 130 == 0) merged.merge(std::exchange(part, {}));
  }
  merged.merge(part);
  merged.merge(RunningStatistics());
  EXPECT_EQ(merged.count(), whole.count());
  EXPECT_NEAR(merged.mean(), whole.mean(), 1e-12);  // rounding of 1000 additions
  EXPECT_NEAR(merged.standardDeviation(), whole.standardDeviation(), 1e-12);
}

TEST(Median, OfManyValuesIsThatOfTheSortedOnes) {
  std::mt19937 random(3);
  std::cauchy_distribution<double> heavy(0.3, 2.0);
  for (const std::size_t count : {4095U, 4096U, 4097U, 50'000U, 50'001U}) {
    std::vector<double> scattered(count), ascending(count), periodic(count), equal(count, 2.0);
    for (std::size_t i = 0; i < count; ++i) {
      scattered[i] = heavy(random);
      ascending[i] = static_cast<double>(i);
      // A sample at equal intervals does not represent these values.
      periodic[i] = i % (count / 1024) == 0 ? static_cast<double>(i) : -static_cast<double>(i);
    }
    for (std::vector<double> values : {scattered, ascending, periodic, equal}) {
      std::vector<double> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      const double upper = sorted[count / 2], lower = sorted[count / 2 - 1];
      EXPECT_EQ(medianInPlace(values), count % 2 == 1 ? upper : 0.5 * (lower + upper)) << count;
    }
  }
}

TEST(Median, OddEvenAndEmpty) {
  std::vector<double> odd{5, 1, 3}, even{4, 1, 3, 2}, empty;
  EXPECT_EQ(medianInPlace(odd), 3.0);
  EXPECT_EQ(medianInPlace(even), 2.5);
  EXPECT_TRUE(std::isnan(medianInPlace(empty)));
}

TEST(RobustSigma, IsTheStandardDeviationOfNormalValues) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal(-4.0, 0.02);
  std::vector<double> values(20001);
  for (double& value : values) value = normal(random);
  // The estimate's own standard deviation is 1.17 sigma / sqrt(n), 0.8 %: four of them.
  EXPECT_NEAR(robustSigma(values), 0.02, 0.04 * 0.02);
}

TEST(RobustSigma, IgnoresOutliers) {
  const std::vector<double> clean{-1, -0.5, 0, 0.5, 1};
  const std::vector<double> spoilt{-1, -0.5, 0, 0.5, 1000};
  EXPECT_DOUBLE_EQ(robustSigma(clean), 1.4826 * 0.5);
  EXPECT_DOUBLE_EQ(robustSigma(spoilt), 1.4826 * 0.5);
  EXPECT_GT(of(spoilt).standardDeviation(), 400.0);
}

TEST(RobustSigma, AboutZeroCountsTheMean) {
  EXPECT_DOUBLE_EQ(robustSigmaAboutZero({9.5, -10.5, 10.0}), 1.4826 * 10.0);
  EXPECT_DOUBLE_EQ(robustSigma({9.5, 10.5, 10.0}), 1.4826 * 0.5);
  EXPECT_TRUE(std::isnan(robustSigmaAboutZero({})));
}

}  // namespace
}  // namespace pcl_als
