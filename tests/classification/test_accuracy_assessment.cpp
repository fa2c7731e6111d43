// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/classification/accuracy_assessment.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

ConfusionMatrix matrixOf(std::initializer_list<std::int64_t> counts) {
  const auto size = static_cast<Eigen::Index>(std::lround(std::sqrt(counts.size())));
  CountMatrix matrix(size, size);
  Eigen::Index k = 0;
  for (const std::int64_t count : counts) {
    matrix(k / size, k % size) = count;
    ++k;
  }
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < size; ++i) names.push_back("class " + std::to_string(i));
  return {names, matrix};
}

double rounded(double value, double digits) {
  return std::round(value * std::pow(10.0, digits)) / std::pow(10.0, digits);
}

// Habib et al. 2011, Table 6 (original data), to the printed digits.
TEST(AccuracyAssessment, ReproducesTable6OfThePaper) {
  const AccuracyResult result =
      assessAccuracy(matrixOf({130, 40, 20, 18, 119, 386, 12, 16, 34, 26, 59, 43, 20, 16, 10, 61}));
  EXPECT_EQ(rounded(100.0 * result.overall.value, 1), 63.0);
  EXPECT_EQ(rounded(result.kappa, 3), 0.442);
  const double conditional[] = {0.464, 0.486, 0.294, 0.502};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(rounded(result.classes[i].kappa, 3), conditional[i]);
  EXPECT_EQ(result.points, 1010);
  // User's and producer's accuracy of trees by hand: 130/208, 130/303.
  EXPECT_DOUBLE_EQ(result.classes[0].users.value, 130.0 / 208.0);
  EXPECT_DOUBLE_EQ(result.classes[0].producers.value, 130.0 / 303.0);
}

// The four sums of Bishop, Fienberg and Holland 1975, an independent way to the same variance.
double varianceOfKappa(const ConfusionMatrix& m) {
  const auto n = static_cast<double>(m.total());
  double t1 = 0, t2 = 0, t3 = 0, t4 = 0;
  const auto row = [&](Eigen::Index i) { return static_cast<double>(m.counts.row(i).sum()); };
  const auto column = [&](Eigen::Index i) { return static_cast<double>(m.counts.col(i).sum()); };
  for (Eigen::Index i = 0; i < m.counts.rows(); ++i) {
    const auto d = static_cast<double>(m.counts(i, i));
    t1 += d / n;
    t2 += row(i) * column(i) / (n * n);
    t3 += d * (row(i) + column(i)) / (n * n);
    for (Eigen::Index j = 0; j < m.counts.cols(); ++j)
      t4 += static_cast<double>(m.counts(i, j)) * std::pow(row(j) + column(i), 2) / (n * n * n);
  }
  return (t1 * (1 - t1) / std::pow(1 - t2, 2) +
          2 * (1 - t1) * (2 * t1 * t2 - t3) / std::pow(1 - t2, 3) +
          std::pow(1 - t1, 2) * (t4 - 4 * t2 * t2) / std::pow(1 - t2, 4)) /
         n;
}

TEST(AccuracyAssessment, DeviationOfKappaIsThatOfTheFourSums) {
  const ConfusionMatrix first = matrixOf({65, 4, 22, 24, 6, 81, 5, 8, 0, 11, 85, 19, 4, 7, 3, 90});
  const ConfusionMatrix second = matrixOf({45, 4, 12, 24, 6, 91, 5, 8, 0, 8, 55, 9, 4, 7, 3, 55});
  for (const ConfusionMatrix& m : {first, second})
    EXPECT_NEAR(std::pow(assessAccuracy(m).kappa_std, 2), varianceOfKappa(m), 1e-15);
  const AccuracyComparison result = compareAccuracy(first, second);
  EXPECT_NEAR(result.kappa_z,
              (assessAccuracy(first).kappa - assessAccuracy(second).kappa) /
                  std::sqrt(varianceOfKappa(first) + varianceOfKappa(second)),
              1e-12);
  EXPECT_FALSE(result.same_points);
}

/// Draws matrices from the shares of one and gives the deviations of kappa and of row 0's kappa.
std::pair<double, double> drawnDeviations(const ConfusionMatrix& truth, int draws) {
  std::mt19937 random(5);
  std::vector<double> weights;
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = 0; j < 4; ++j) weights.push_back(static_cast<double>(truth.counts(i, j)));
  std::discrete_distribution<int> cell(weights.begin(), weights.end());
  double sums[4] = {0, 0, 0, 0};
  for (int draw = 0; draw < draws; ++draw) {
    ConfusionMatrix m(truth.classes);
    for (std::int64_t k = 0; k < truth.total(); ++k) {
      const int at = cell(random);
      ++m.counts(at / 4, at % 4);
    }
    const AccuracyResult result = assessAccuracy(m);
    const double values[] = {result.kappa, result.classes[0].kappa};
    for (int k = 0; k < 2; ++k) sums[2 * k] += values[k], sums[2 * k + 1] += values[k] * values[k];
  }
  const auto deviation = [&](int k) {
    const double mean = sums[2 * k] / draws;
    return std::sqrt(sums[2 * k + 1] / draws - mean * mean);
  };
  return {deviation(0), deviation(1)};
}

// 4000 draws know a deviation to 1.1 % (1 / sqrt(2 n)); large-sample formulas with 208 points in
// the row are good to some per cent: 5 %.
TEST(AccuracyAssessment, DeviationsAreThoseOfRepeatedDraws) {
  const ConfusionMatrix truth =
      matrixOf({130, 40, 20, 18, 119, 386, 12, 16, 34, 26, 59, 43, 20, 16, 10, 61});
  const AccuracyResult result = assessAccuracy(truth);
  const auto [kappa, conditional] = drawnDeviations(truth, 4000);
  EXPECT_NEAR(result.kappa_std / kappa, 1.0, 0.05);
  EXPECT_NEAR(result.classes[0].kappa_std / conditional, 1.0, 0.05);
}

// Wilson 1927 by hand: 8 of 10 gives (0.49016, 0.94333).
TEST(AccuracyAssessment, IntervalIsWilsons) {
  const AccuracyResult result = assessAccuracy(matrixOf({4, 1, 1, 4}));
  EXPECT_NEAR(result.overall.low, 0.49016, 5e-6);
  EXPECT_NEAR(result.overall.high, 0.94332, 5e-5);
}

TEST(AccuracyAssessment, SaysWhatIsNotDefined) {
  const AccuracyResult result = assessAccuracy(matrixOf({5, 0, 2, 0, 0, 0, 1, 0, 3}));
  EXPECT_TRUE(std::isnan(result.classes[1].users.value));
  EXPECT_TRUE(std::isnan(result.classes[1].kappa));
  EXPECT_EQ(result.remarks.size(), 2U);
  EXPECT_TRUE(std::isnan(assessAccuracy(matrixOf({7, 0, 0, 0})).kappa));
  EXPECT_THROW(assessAccuracy(matrixOf({0, 0, 0, 0})), UsageError);
  EXPECT_THROW(ConfusionMatrix({"a"}, CountMatrix::Zero(2, 2)), UsageError);
  EXPECT_THROW(ConfusionMatrix({"a"}, CountMatrix::Constant(1, 1, -1)), UsageError);
}

/// \a both right, \a first only, \a second only, none; two classes by turns.
void outcomes(int both, int first, int second, int none, std::vector<CheckedPoint>& a,
              std::vector<CheckedPoint>& b) {
  int k = 0;
  const auto add = [&](int count, bool right_a, bool right_b) {
    for (int i = 0; i < count; ++i, ++k) {
      const int truth = k % 2;
      a.push_back({right_a ? truth : 1 - truth, truth});
      b.push_back({right_b ? truth : 1 - truth, truth});
    }
  };
  add(both, true, true), add(first, true, false), add(second, false, true), add(none, false, false);
}

// By hand: chi-square (|10 - 2| - 1)^2 / 12; exact p = 2 (1 + 12 + 66) / 4096.
TEST(AccuracyAssessment, McNemarByHand) {
  std::vector<CheckedPoint> a, b;
  outcomes(50, 10, 2, 8, a, b);
  const AccuracyComparison result = compareAccuracy({"x", "y"}, a, b);
  EXPECT_TRUE(result.same_points);
  EXPECT_EQ(result.only_first_right, 10);
  EXPECT_EQ(result.only_second_right, 2);
  EXPECT_NEAR(result.mcnemar_chi_sq, 49.0 / 12.0, 1e-12);
  EXPECT_NEAR(result.mcnemar_p, 158.0 / 4096.0, 1e-12);
  EXPECT_NEAR(result.overall_difference, 8.0 / 70.0, 1e-12);
}

// Common points make the difference better known than independent ones would; nothing differs when
// nothing differs.
TEST(AccuracyAssessment, CommonPointsGiveTheKappasACovariance) {
  std::vector<CheckedPoint> a, b;
  outcomes(160, 12, 4, 24, a, b);
  const std::vector<std::string> names{"x", "y"};
  const AccuracyComparison paired = compareAccuracy(names, a, b);
  const AccuracyComparison apart = compareAccuracy(countPoints(names, a), countPoints(names, b));
  EXPECT_DOUBLE_EQ(paired.kappa_difference, apart.kappa_difference);
  EXPECT_LT(paired.kappa_difference_std, 0.7 * apart.kappa_difference_std);
  // Two balanced classes: kappa = 2 overall - 1, so the deviation is twice that of the difference
  // of proportions, sqrt((b + c) - (b - c)^2 / n) / n.
  EXPECT_NEAR(paired.kappa_difference_std, 2.0 * std::sqrt(16.0 - 64.0 / 200.0) / 200.0, 2e-3);
  const AccuracyComparison same = compareAccuracy(names, a, a);
  EXPECT_EQ(same.kappa_difference, 0.0);
  EXPECT_EQ(same.mcnemar_p, 1.0);
  EXPECT_TRUE(std::isnan(same.kappa_p));
  b.pop_back();
  EXPECT_THROW(compareAccuracy(names, a, b), UsageError);
}

}  // namespace
}  // namespace pcl_als
