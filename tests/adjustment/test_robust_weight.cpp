// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/adjustment/robust_weight.h>

namespace pcl_als {
namespace {

// Huber 1964: with k = 1.5, a residual of three deviations has half the weight.
TEST(RobustWeight, IsHubers) {
  EXPECT_EQ(huberWeight(0.0), 1.0);
  EXPECT_EQ(huberWeight(1.5), 1.0);
  EXPECT_EQ(huberWeight(-3.0), 0.5);
  EXPECT_EQ(huberWeight(0.06, 0.02), 0.5);
  EXPECT_EQ(huberWeight(0.0, 0.0), 1.0);
  EXPECT_EQ(huberWeight(4.0, 1.0, 1.0), 0.25);
}

TEST(RobustWeight, RejectsBeyondTheLimit) {
  const RobustWeight weight;
  EXPECT_EQ(weight(-3.0), 0.5);
  EXPECT_NEAR(weight(4.5), 1.0 / 3.0, 1e-15);
  EXPECT_EQ(weight(4.6), 0.0);
  EXPECT_EQ(weight(-0.46, 0.1), 0.0);
  EXPECT_FALSE(weight.rejects(0.46, 0.2));
  EXPECT_NEAR((RobustWeight{1.0, kNoRejection})(1e3), 1e-3, 1e-15);
  EXPECT_EQ((RobustWeight{1.0, kNoRejection})(0.0, 0.0), 1.0);
}

// The weight is the derivative of the loss over the residual; against central differences.
TEST(RobustWeight, IsTheDerivativeOfTheLoss) {
  for (const double residual : {-7.0, -1.6, -0.3, 0.4, 1.4, 2.5}) {
    const double step = 1e-5;
    const double derivative =
        (huberLoss(residual + step) - huberLoss(residual - step)) / (2.0 * step);
    EXPECT_NEAR(derivative / residual, huberWeight(residual), 1e-9) << residual;
  }
}

}  // namespace
}  // namespace pcl_als
