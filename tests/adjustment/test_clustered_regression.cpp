// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/adjustment/clustered_regression.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

// Four clusters of one value each: the covariance of a mean is then the usual one.
TEST(ClusteredRegression, MeanOfIndependentValuesByHand) {
  ClusteredRegression mean(1);
  const double values[] = {1.0, 2.0, 3.0, 6.0};  // mean 3, squares 4 + 1 + 0 + 9 = 14
  for (int i = 0; i < 4; ++i) mean.add(i, Eigen::VectorXd::Ones(1), values[i]);
  const auto result = mean.solve();
  ASSERT_TRUE(result.determined);
  EXPECT_NEAR(result.estimate[0], 3.0, 1e-12);
  // c = 4/3 * 3/3; Cov = c * 14 / 16: the same as 14 / 3 / 4.
  EXPECT_NEAR(result.std(0), std::sqrt(14.0 / 12.0), 1e-12);
  EXPECT_EQ(result.clusters, 4U);
}

// Every value twice in its cluster says nothing new: c changes by (n-1)/(n-m) only.
TEST(ClusteredRegression, RepeatedValuesInAClusterAreNoNews) {
  ClusteredRegression mean(1);
  const double values[] = {1.0, 2.0, 3.0, 6.0};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 100; ++k) mean.add(i, Eigen::VectorXd::Ones(1), values[i]);
  EXPECT_NEAR(mean.solve().std(0), std::sqrt(14.0 / 12.0), 1e-12);
}

TEST(ClusteredRegression, LineThroughExactValues) {
  ClusteredRegression line(2);
  for (int i = 0; i < 10; ++i) line.add(i / 2, Eigen::Vector2d(1.0, 0.1 * i), 2.0 - 0.3 * i);
  const auto result = line.solve();
  ASSERT_TRUE(result.determined);
  EXPECT_NEAR(result.estimate[0], 2.0, 1e-12);
  EXPECT_NEAR(result.estimate[1], -3.0, 1e-11);
  EXPECT_NEAR(result.std(1), 0.0, 1e-10);
}

// 200 samples of 40 clusters whose members share an error as large as their own: about 95 % of the
// errors are within 1.96 standard deviations (binomial: 3.1 % more or less is two of its own); with
// the usual formula of independent values it would be about 40 %.
TEST(ClusteredRegression, StandardDeviationCoversSharedErrors) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  int within = 0, within_usual = 0;
  constexpr int kSamples = 200;
  for (int sample = 0; sample < kSamples; ++sample) {
    ClusteredRegression line(2);
    for (int cluster = 0; cluster < 40; ++cluster) {
      const double shared = noise(random), x = noise(random);
      for (int i = 0; i < 25; ++i)
        line.add(cluster, Eigen::Vector2d(1.0, x), 5.0 + 2.0 * x + shared + noise(random));
    }
    const auto result = line.solve();
    within += std::abs(result.estimate[1] - 2.0) < 1.96 * result.std(1) ? 1 : 0;
    within_usual +=
        std::abs(result.estimate[1] - 2.0) < 1.96 * result.rms / std::sqrt(1000.0) ? 1 : 0;
  }
  EXPECT_GE(within, 178);  // 0.95 less two deviations, less the bias of 40 clusters (2 %)
  EXPECT_LT(within_usual, 120);
}

TEST(ClusteredRegression, RobustSolutionIgnoresATenth) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.01);
  ClusteredRegression mean(1);
  for (int i = 0; i < 1000; ++i)
    mean.add(i / 20, Eigen::VectorXd::Ones(1), i % 10 == 0 ? 1.0 : noise(random));
  EXPECT_NEAR(mean.solve().estimate[0], 0.1, 0.002);  // a tenth of the outliers' metre
  EXPECT_NEAR(mean.solve(true).estimate[0], 0.0, 0.004);
}

TEST(ClusteredRegression, SaysWhatItCannotTell) {
  ClusteredRegression few(1);
  EXPECT_FALSE(few.solve().determined);
  for (int i = 0; i < 100; ++i) few.add(i % 2, Eigen::VectorXd::Ones(1), i);
  EXPECT_FALSE(few.solve().determined) << "two clusters say nothing of their scatter";
  EXPECT_TRUE(std::isnan(few.solve().std(0)));
  ClusteredRegression singular(2);
  for (int i = 0; i < 100; ++i) singular.add(i, Eigen::Vector2d(1.0, 2.0), i);
  EXPECT_FALSE(singular.solve().determined);
  EXPECT_THROW(ClusteredRegression(0), UsageError);
  EXPECT_THROW(few.add(0, Eigen::Vector2d::Zero(), 0.0), UsageError);
}

}  // namespace
}  // namespace pcl_als
