// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/adjustment/correlated_errors.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

using Row = CorrelatedErrors::Row;

/// A strip of 800 m x 60 m with a height every 5 m x 20 m: noise of 1 cm, and an error that all
/// places across share, 2 cm, which decays along the strip as exp(-distance / range).
struct Strip {
  double mean = 0.0, std = 0.0, formal = 0.0;

  Strip(double range, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    const double decay = range > 0.0 ? std::exp(-5.0 / range) : 0.0;
    std::vector<std::pair<Eigen::Vector2d, double>> heights;
    double shared = normal(random);
    for (double y = 0.0; y < 800.0; y += 5.0) {
      shared = decay * shared + std::sqrt(1.0 - decay * decay) * normal(random);
      for (double x = 0.0; x < 60.0; x += 20.0)
        heights.emplace_back(Eigen::Vector2d(691000.0 + x, 5335000.0 + y),
                             (range > 0.0 ? 0.02 * shared : 0.0) + 0.01 * normal(random));
    }
    const auto count = static_cast<double>(heights.size());
    for (const auto& [place, height] : heights) mean += height / count;
    CorrelatedErrors errors(1, 1);
    double squares = 0.0;
    for (const auto& [place, height] : heights) {
      errors.add(place, Row::Ones(1), Row::Ones(1), 1.0, height - mean);
      squares += (height - mean) * (height - mean);
    }
    std = std::sqrt(errors.solve().covariance(0, 0));
    formal = std::sqrt(squares / count / (count - 1.0));
  }
};

// Errors of the mean over their standard deviations, RMS of 60 strips: 1 if they cover, known to
// 9 % (three of which are 27 %).
TEST(CorrelatedErrors, CoversErrorsThatVarySlowly) {
  double covered = 0.0, formal = 0.0;
  constexpr int kStrips = 60;
  for (unsigned seed = 1; seed <= kStrips; ++seed) {
    const Strip strip(120.0, seed);
    covered += std::pow(strip.mean / strip.std, 2) / kStrips;
    formal += std::pow(strip.mean / strip.formal, 2) / kStrips;
  }
  EXPECT_LT(std::sqrt(covered), 1.3);
  EXPECT_GT(std::sqrt(covered), 0.6);
  EXPECT_GT(std::sqrt(formal), 3.0) << "as independent observations";
}

// Independent errors: the standard deviation stays near that of independent observations. The
// average includes shared errors that the data cannot exclude, hence up to 60 % more.
TEST(CorrelatedErrors, AddsLittleToIndependentErrors) {
  double ratio = 0.0;
  constexpr int kStrips = 20;
  for (unsigned seed = 1; seed <= kStrips; ++seed) {
    const Strip strip(0.0, seed);
    ratio += strip.std / strip.formal / kStrips;
  }
  EXPECT_GT(ratio, 0.9);
  EXPECT_LT(ratio, 1.6);
}

TEST(CorrelatedErrors, RefusesWhatItCannotUse) {
  EXPECT_THROW(CorrelatedErrors(0, 1), UsageError);
  EXPECT_THROW(CorrelatedErrors(8, 1), UsageError);
  EXPECT_THROW(CorrelatedErrors(1, 2), UsageError);
  CorrelatedErrors errors(1, 1);
  EXPECT_FALSE(errors.solve().determined) << "no observation";
  errors.add(Eigen::Vector2d::Zero(), Row::Ones(1), Row::Ones(1), 1.0, 0.01);
  EXPECT_FALSE(errors.solve().determined) << "one cell";
  EXPECT_THROW(errors.add(Eigen::Vector2d::Zero(), Row::Ones(2), Row::Ones(1), 1.0, 0.01),
               UsageError);
}

// What is measured exactly has no error, and no likelihood of any.
TEST(CorrelatedErrors, ExactObservationsHaveNoError) {
  CorrelatedErrors errors(1, 1);
  for (int i = 0; i < 20; ++i) errors.add({30.0 * i, 0.0}, Row::Ones(1), Row::Ones(1), 1.0, 0.0);
  const CorrelatedErrors::Result result = errors.solve();
  ASSERT_TRUE(result.determined);
  EXPECT_EQ(result.covariance(0, 0), 0.0);
}

}  // namespace
}  // namespace pcl_als
