// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <pcl_als/adjustment/banded_normal.h>
#include <pcl_als/adjustment/cubic_spline.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

constexpr int kUnknowns = 12, kBand = 3, kCommon = 2;

/// Observations of neighbours and of the common unknowns, in both forms.
struct Pair {
  BandedNormal banded{kUnknowns, kBand, kCommon};
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(kUnknowns + kCommon, kUnknowns + kCommon);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kUnknowns + kCommon);

  void observe(int first, const Eigen::VectorXd& row, double value) {
    Eigen::VectorXd full = Eigen::VectorXd::Zero(kUnknowns + kCommon);
    full.segment(first, kBand + 1) = row.head(kBand + 1);
    full.tail(kCommon) = row.tail(kCommon);
    dense += full * full.transpose();
    right += value * full;
    for (int i = 0; i <= kBand; ++i) {
      banded.addRight(first + i, value * row[i]);
      for (int j = 0; j <= i; ++j) banded.add(first + i, first + j, row[i] * row[j]);
      for (int c = 0; c < kCommon; ++c) banded.addBorder(first + i, c, row[i] * row[kBand + 1 + c]);
    }
    const Eigen::VectorXd common = row.tail(kCommon);
    banded.addCorner(common * common.transpose(), value * common);
  }
};

Pair randomPair() {
  Pair pair;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 60; ++k) {
    Eigen::VectorXd row(kBand + 1 + kCommon);
    for (double& value : row) value = normal(random);
    pair.observe(k % (kUnknowns - kBand), row, normal(random));
  }
  return pair;
}

// Both solve the same regular equations: equal to rounding.
TEST(BandedNormal, EqualsTheDenseSolution) {
  Pair pair = randomPair();
  ASSERT_TRUE(pair.banded.solve());
  const Eigen::MatrixXd inverse = pair.dense.inverse();
  const Eigen::VectorXd solution = inverse * pair.right;
  EXPECT_LT((pair.banded.solution() - solution.head(kUnknowns)).norm(), 1e-10);
  EXPECT_LT((pair.banded.commonSolution() - solution.tail(kCommon)).norm(), 1e-10);
  EXPECT_LT((pair.banded.commonCovariance() - inverse.bottomRightCorner<kCommon, kCommon>()).norm(),
            1e-10);
  for (int i = 0; i < kUnknowns; ++i)
    for (int j = std::max(0, i - kBand); j <= std::min(kUnknowns - 1, i + kBand); ++j)
      EXPECT_NEAR(pair.banded.covariance(i, j), inverse(i, j), 1e-10) << i << ' ' << j;
}

TEST(BandedNormal, ReportsSingularEquations) {
  BandedNormal normal(3, 1, 0);
  normal.add(0, 0, 1.0);
  normal.add(1, 1, 1.0);
  normal.add(1, 0, 1.0);  // the first two unknowns in one sum only
  normal.add(2, 2, 1.0);
  EXPECT_FALSE(normal.solve());
  EXPECT_THROW(BandedNormal(0, 1, 0), UsageError);
}

TEST(UniformCubicSpline, ReproducesAPolynomialOfFirstDegree) {
  const UniformCubicSpline spline(2.0, 5.0, 0.7);
  EXPECT_NEAR(spline.to(), 5.0, 1e-12);
  for (const double time : {2.0, 2.31, 3.5, 4.99, 5.0}) {
    const UniformCubicSpline::Weights at = spline.at(time);
    double sum = 0.0, value = 0.0, slope = 0.0;
    for (int k = 0; k < 4; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double knot = spline.from() + (at.first + k - 1) * spline.step();
      sum += at.value[i];
      value += at.value[i] * knot;
      slope += at.slope[i] * knot;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_NEAR(value, time, 1e-12);
    EXPECT_NEAR(slope, 1.0, 1e-12);
    EXPECT_LE(at.first + 4, spline.count());
  }
}

}  // namespace
}  // namespace pcl_als
