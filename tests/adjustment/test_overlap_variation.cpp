// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/adjustment/overlap_variation.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

/// Differences value(x, y) on 200 m x 100 m, one in 4 m, cells of 25 m being groups.
template <typename Value>
OverlapVariation variationOf(Value value, unsigned seed = 1, double noise = 0.01) {
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, noise);
  OverlapVariation variation;
  for (int y = -48; y <= 48; y += 4)
    for (int x = -98; x <= 98; x += 4)
      variation.add(100 * std::lround(std::floor(y / 25.0)) + std::lround(std::floor(x / 25.0)),
                    {x, y}, value(x, y) + error(random));
  return variation;
}

// 50 columns of 4 m: their mean square distance from the middle is 4^2 (50^2 - 1) / 12 m^2.
constexpr double kMeanSquareX = 16.0 * 2499.0 / 12.0;
constexpr double kMeanSquareY = 16.0 * 624.0 / 12.0;

TEST(OverlapVariation, TiltIsWhatTheOffsetVariesBy) {
  constexpr double kTilt = 5e-4;
  const auto tilted = variationOf([](double x, double) { return 0.1 + kTilt * x; });
  // The noise leaves 1e-5 of the tilt, and twice that of its square.
  EXPECT_NEAR(std::sqrt(tilted.ofOffset()), kTilt * std::sqrt(kMeanSquareX), 0.001);
  EXPECT_EQ(tilted.ofRotations(), Eigen::Vector2d(0.0, 0.0));
}

// z = b x^2 / 2 has the slope b x along x: a rotation about the y axis.
TEST(OverlapVariation, BendIsWhatTheRotationsVaryBy) {
  constexpr double kBend = 2e-5;
  const auto bent = variationOf([](double x, double) { return 0.5 * kBend * x * x; });
  EXPECT_NEAR(std::sqrt(bent.ofRotations()[1]), kBend * std::sqrt(kMeanSquareX), 5e-5);
  EXPECT_LT(std::sqrt(bent.ofRotations()[0]), 5e-5);
  // z = b x y has the slope b y along x and b x along y.
  const auto twisted = variationOf([](double x, double y) { return kBend * x * y; });
  EXPECT_NEAR(std::sqrt(twisted.ofRotations()[0]), kBend * std::sqrt(kMeanSquareX), 5e-5);
  EXPECT_NEAR(std::sqrt(twisted.ofRotations()[1]), kBend * std::sqrt(kMeanSquareY), 5e-5);
}

// The test is at 95 %, and the covariance of 32 groups is slightly too small: of 200 samples of
// noise alone ten are expected to be significant, with 3.1 of its own standard deviation.
TEST(OverlapVariation, NoiseRarelyCounts) {
  int offsets = 0, rotations = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const auto rigid = variationOf([](double, double) { return 0.05; }, seed);
    offsets += rigid.ofOffset() > 0.0 ? 1 : 0;
    rotations += rigid.ofRotations().maxCoeff() > 0.0 ? 1 : 0;
  }
  EXPECT_LE(offsets, 20);
  EXPECT_LE(rotations, 20);
}

TEST(OverlapVariation, TooLittleShowsNothing) {
  OverlapVariation variation;
  EXPECT_EQ(variation.ofOffset(), 0.0);
  for (int i = 0; i < 5; ++i) variation.add(0, {i, i * i}, i);
  EXPECT_EQ(variation.ofOffset(), 0.0);  // one group
  EXPECT_EQ(variation.ofRotations(), Eigen::Vector2d(0.0, 0.0));
  // 95 % of chi-squared with four degrees of freedom: 9.488.
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(4, 4);
  EXPECT_EQ(significantMeanSquare(Eigen::VectorXd::Constant(4, 1.54), unit, unit), 0.0);
  EXPECT_NEAR(significantMeanSquare(Eigen::VectorXd::Constant(4, 1.541), unit, unit),
              4.0 * 1.541 * 1.541, 1e-12);
}

}  // namespace
}  // namespace pcl_als
