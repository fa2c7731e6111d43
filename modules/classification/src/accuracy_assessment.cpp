// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <pcl_als/classification/accuracy_assessment.h>
#include <pcl_als/common/distributions.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
const double kNormal95 = normalCritical(0.025);  // 95 % of normal errors are smaller

Proportion wilson(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return {kNone, kNone, kNone};
  const auto n = static_cast<double>(whole);
  const double p = static_cast<double>(part) / n, z_sq = kNormal95 * kNormal95;
  const double centre = (p + z_sq / (2.0 * n)) / (1.0 + z_sq / n);
  const double half =
      kNormal95 / (1.0 + z_sq / n) * std::sqrt(p * (1.0 - p) / n + z_sq / (4.0 * n * n));
  return {p, std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

/// Kappa of a matrix and its derivatives by the shares of points.
struct Kappa {
  explicit Kappa(const CountMatrix& counts) {
    shares = counts.cast<double>() / static_cast<double>(counts.sum());
    const Eigen::VectorXd rows = shares.rowwise().sum(), columns = shares.colwise().sum();
    const double agreed = shares.trace(), by_chance = rows.dot(columns),
                 beyond_chance = 1.0 - by_chance;
    value = beyond_chance > 0.0 ? (agreed - by_chance) / beyond_chance : kNone;
    gradient.resize(shares.rows(), shares.cols());
    for (Eigen::Index i = 0; i < shares.rows(); ++i)
      for (Eigen::Index j = 0; j < shares.cols(); ++j)
        gradient(i, j) =
            ((i == j ? beyond_chance : 0.0) - (1.0 - agreed) * (columns[i] + rows[j])) /
            (beyond_chance * beyond_chance);
  }
  double variance(double points) const {
    const double mean = shares.cwiseProduct(gradient).sum();
    return std::max(0.0, shares.cwiseProduct(gradient.cwiseAbs2()).sum() - mean * mean) / points;
  }

  Eigen::MatrixXd shares, gradient;
  double value = kNone;
};

/// Bishop, Fienberg and Holland 1975, in counts.
void conditionalKappa(double n, ClassAccuracy& row) {
  const auto a = static_cast<double>(row.correct), r = static_cast<double>(row.classified),
             c = static_cast<double>(row.reference);
  const double beyond_chance = r * (n - c);
  row.kappa = beyond_chance > 0.0 ? (n * a - r * c) / beyond_chance : kNone;
  row.kappa_std = beyond_chance > 0.0
                      ? std::sqrt(n * (r - a) / (beyond_chance * beyond_chance * beyond_chance) *
                                  ((r - a) * (r * c - n * a) + n * a * (n - r - c + a)))
                      : kNone;
}

/// Both tails of a fair coin's tosses.
double signTest(std::int64_t one, std::int64_t other) {
  const auto fewer = static_cast<double>(std::min(one, other));
  return std::min(1.0, 2.0 * binomialUpTo(fewer, static_cast<double>(one + other), 0.5));
}

void judgeDifference(double variance, AccuracyComparison& result) {
  result.kappa_difference_std = std::sqrt(std::max(0.0, variance));
  const bool judged = result.kappa_difference_std > 0.0;
  result.kappa_z = judged ? result.kappa_difference / result.kappa_difference_std : kNone;
  result.kappa_p = judged ? 2.0 * normalTail(std::abs(result.kappa_z)) : kNone;
}

double overallOf(const ConfusionMatrix& matrix) {
  return static_cast<double>(matrix.counts.trace()) / static_cast<double>(matrix.total());
}

void requirePoints(const ConfusionMatrix& matrix) {
  if (matrix.total() == 0) throw UsageError("a confusion matrix without points has no accuracy");
}

}  // namespace

ConfusionMatrix::ConfusionMatrix(std::vector<std::string> names) : classes(std::move(names)) {
  const auto size = static_cast<Eigen::Index>(classes.size());
  counts = CountMatrix::Zero(size, size);
}

ConfusionMatrix::ConfusionMatrix(std::vector<std::string> names, CountMatrix values)
    : classes(std::move(names)), counts(std::move(values)) {
  const auto size = static_cast<Eigen::Index>(classes.size());
  if (counts.rows() != size || counts.cols() != size)
    throw UsageError("a confusion matrix needs as many rows and columns as classes");
  if (size > 0 && counts.minCoeff() < 0)
    throw UsageError("a confusion matrix has no negative counts");
}

AccuracyResult assessAccuracy(const ConfusionMatrix& matrix) {
  requirePoints(matrix);
  AccuracyResult result;
  result.points = matrix.total();
  result.correct = matrix.counts.trace();
  result.overall = wilson(result.correct, result.points);
  const auto n = static_cast<double>(result.points);
  const Kappa kappa(matrix.counts);
  result.kappa = kappa.value;
  result.kappa_std = std::isnan(kappa.value) ? kNone : std::sqrt(kappa.variance(n));
  result.kappa_interval = {kappa.value, kappa.value - kNormal95 * result.kappa_std,
                           kappa.value + kNormal95 * result.kappa_std};
  if (std::isnan(kappa.value)) result.remarks.emplace_back("all points are of one class: no kappa");
  for (std::size_t i = 0; i < matrix.classes.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    ClassAccuracy row;
    row.name = matrix.classes[i];
    row.classified = matrix.counts.row(k).sum();
    row.reference = matrix.counts.col(k).sum();
    row.correct = matrix.counts(k, k);
    row.users = wilson(row.correct, row.classified);
    row.producers = wilson(row.correct, row.reference);
    conditionalKappa(n, row);
    if (row.classified == 0) result.remarks.push_back("no check point was classified " + row.name);
    if (row.reference == 0) result.remarks.push_back("no check point is " + row.name);
    result.classes.push_back(std::move(row));
  }
  return result;
}

ConfusionMatrix countPoints(const std::vector<std::string>& classes,
                            const std::vector<CheckedPoint>& points) {
  ConfusionMatrix matrix(classes);
  const auto size = static_cast<int>(classes.size());
  for (const CheckedPoint& point : points) {
    if (point.classified < 0 || point.classified >= size || point.reference < 0 ||
        point.reference >= size)
      throw UsageError("a check point of a class that has no name");
    ++matrix.counts(point.classified, point.reference);
  }
  return matrix;
}

AccuracyComparison compareAccuracy(const ConfusionMatrix& first, const ConfusionMatrix& second) {
  requirePoints(first);
  requirePoints(second);
  const Kappa a(first.counts), b(second.counts);
  AccuracyComparison result;
  result.overall_difference = overallOf(first) - overallOf(second);
  result.kappa_difference = a.value - b.value;
  judgeDifference(a.variance(static_cast<double>(first.total())) +
                      b.variance(static_cast<double>(second.total())),
                  result);
  return result;
}

AccuracyComparison compareAccuracy(const std::vector<std::string>& classes,
                                   const std::vector<CheckedPoint>& first,
                                   const std::vector<CheckedPoint>& second) {
  if (first.size() != second.size() || first.empty())
    throw UsageError("a comparison needs the same check points in both classifications");
  const ConfusionMatrix counts_a = countPoints(classes, first),
                        counts_b = countPoints(classes, second);
  const Kappa a(counts_a.counts), b(counts_b.counts);
  AccuracyComparison result;
  result.same_points = true;
  result.overall_difference = overallOf(counts_a) - overallOf(counts_b);
  result.kappa_difference = a.value - b.value;
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i].reference != second[i].reference)
      throw UsageError("a comparison needs the same check points in both classifications");
    const double influence = a.gradient(first[i].classified, first[i].reference) -
                             b.gradient(second[i].classified, second[i].reference);
    sum += influence;
    squares += influence * influence;
    const bool right_a = first[i].classified == first[i].reference;
    const bool right_b = second[i].classified == second[i].reference;
    result.only_first_right += right_a && !right_b;
    result.only_second_right += right_b && !right_a;
  }
  const auto n = static_cast<double>(first.size());
  judgeDifference((squares / n - sum / n * (sum / n)) / n, result);
  const std::int64_t differing = result.only_first_right + result.only_second_right;
  const double gap = std::max(
      0.0, std::abs(static_cast<double>(result.only_first_right - result.only_second_right)) - 1.0);
  result.mcnemar_chi_sq = differing > 0 ? gap * gap / static_cast<double>(differing) : 0.0;
  result.mcnemar_p = signTest(result.only_first_right, result.only_second_right);
  return result;
}

}  // namespace pcl_als
