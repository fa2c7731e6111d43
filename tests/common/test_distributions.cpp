// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/common/distributions.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als {
namespace {

// Values of printed tables, to their last digit.
TEST(Distributions, TabulatedCriticalValues) {
  EXPECT_NEAR(normalCritical(0.025), 1.9600, 5e-5);
  EXPECT_NEAR(normalCritical(0.005), 2.5758, 5e-5);
  EXPECT_NEAR(chiSquaredCritical(0.05, 1), 3.841, 5e-4);
  EXPECT_NEAR(chiSquaredCritical(0.05, 3), 7.815, 5e-4);
  EXPECT_NEAR(chiSquaredCritical(0.01, 10), 23.209, 5e-4);
  EXPECT_NEAR(studentCritical(0.025, 1), 12.706, 5e-4);
  EXPECT_NEAR(studentCritical(0.025, 2), 4.303, 5e-4);
  EXPECT_NEAR(studentCritical(0.0005, 30), 3.646, 5e-4);
}

TEST(Distributions, ByHand) {
  EXPECT_EQ(normalTail(0.0), 0.5);
  EXPECT_NEAR(normalTail(-1.0), 1.0 - 0.15865525393145707, 1e-15);
  // Two degrees of freedom: exp(-x / 2); one: a normal value on either side.
  EXPECT_NEAR(chiSquaredTail(100.0, 2), std::exp(-50.0), 1e-12 * std::exp(-50.0));
  EXPECT_NEAR(chiSquaredTail(9.0, 1), 2.0 * normalTail(3.0), 1e-15);
  // One degree of freedom is Cauchy's distribution: a quarter beyond 1.
  EXPECT_NEAR(studentTail(1.0, 1), 0.25, 1e-15);
  EXPECT_NEAR(studentTail(2.0, 1e9), normalTail(2.0), 1e-9);
  // (1 + 10 + 45 + 120) / 1024, and no trial.
  EXPECT_NEAR(binomialUpTo(3, 10, 0.5), 176.0 / 1024.0, 1e-15);
  EXPECT_EQ(binomialUpTo(0, 0, 0.5), 1.0);
}

TEST(Distributions, CriticalValuesAreTheInverse) {
  for (const double tail : {1e-300, 1e-12, 0.01, 0.5, 0.9}) {
    EXPECT_NEAR(normalTail(normalCritical(tail)) / tail, 1.0, 1e-11) << tail;
    EXPECT_NEAR(chiSquaredTail(chiSquaredCritical(tail, 4), 4) / tail, 1.0, 1e-11) << tail;
    if (tail < 1e-100) continue;
    EXPECT_NEAR(studentTail(studentCritical(tail, 4), 4) / tail, 1.0, 1e-11) << tail;
  }
}

TEST(Distributions, NoExceptions) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(normalCritical(0.0), infinity);
  EXPECT_EQ(chiSquaredCritical(0.0, 3), infinity);
  EXPECT_EQ(normalTail(infinity), 0.0);
  EXPECT_TRUE(std::isnan(normalTail(std::nan(""))));
  EXPECT_TRUE(std::isnan(chiSquaredCritical(0.05, 0)));
  EXPECT_TRUE(std::isnan(chiSquaredTail(-1.0, 2)));
  EXPECT_TRUE(std::isnan(studentCritical(0.05, -1)));
  EXPECT_TRUE(std::isnan(binomialUpTo(4, 3, 0.5)));
}

// The factor of the NMAD is the reciprocal of the upper quartile of normal errors, to five digits.
TEST(Distributions, ScaleOfTheMedianDeviation) {
  EXPECT_NEAR(robustSigmaAboutZero({normalCritical(0.25)}), 1.0, 5e-5 / 1.4826);
}

}  // namespace
}  // namespace pcl_als
