// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "data_snooping.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/adjustment/robust_weight.h>
#include <pcl_als/common/distributions.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als::photogrammetry {
namespace {

/// Variances of residuals below this share of that of the observation are rounding: the
/// observation is not controlled by others.
constexpr double kLeastRedundancy = 1e-4;
/// The second largest residual of a feature is this share of the largest: both may be wrong.
constexpr double kNearlyEqual = 0.9;

/// So many measurements of a line, and more than half of them, do not agree with its control: the
/// control is wrong, not they.
constexpr std::size_t kWrongPlaces = 3;
/// Smaller test values than this share of the greatest may be consequences of the greatest.
constexpr double kShareOfGreatest = 0.1;
/// A point whose rays meet at so small an angle that its depth has this standard deviation, as a
/// share of the distance from the images, is the result of blunders.
constexpr double kLargestDepthError = 0.1;

/// v' Q^-1 v over the determined directions, and their number.
std::pair<double, int> quadraticForm(const Eigen::VectorXd& v, const Eigen::MatrixXd& q) {
  const SymmetricEigen<Eigen::Dynamic> eigen = symmetricEigen(q);
  std::pair<double, int> sum{0.0, 0};
  for (int i = 0; i < v.size(); ++i) {
    if (eigen.values[i] < kLeastRedundancy) continue;
    sum.first += std::pow(eigen.vectors.col(i).dot(v), 2) / eigen.values[i];
    ++sum.second;
  }
  return sum;
}

/// Normal deviate of the same probability as a value of chi-squared, at least 0. Where the
/// probability is 0 to the computer, the root, which is a little larger, orders the values.
double normalDeviate(double chi_squared, int freedom) {
  if (freedom == 0) return 0.0;
  if (freedom == 1) return std::sqrt(chi_squared);
  const double deviate = normalCritical(chiSquaredTail(chi_squared, freedom));
  return std::max(0.0, std::min(std::sqrt(chi_squared), deviate));
}

}  // namespace

TestValue testOf(const Observation& o, const Observation::Linear& linear,
                 const BundleNormal& normal) {
  const Eigen::MatrixXd q =
      Eigen::MatrixXd::Identity(o.rows(), o.rows()) - normal.adjustedCovariance(o, linear);
  const auto [form, freedom] = quadraticForm(linear.residual, q);
  return {normalDeviate(form, freedom), freedom > 0 ? std::sqrt(form / freedom) : 0.0, q.trace()};
}

std::size_t Snooping::rejectFarPoints(BundleProblem& problem, const BundleNormal& normal) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    const Observation& o = problem.observations[i];
    if (!problem.inUse(o) || o.measurement == Observation::kNone) continue;
    Feature& feature = problem.features[o.feature];
    if (feature.line) continue;
    const Eigen::Vector3d from = problem.images[o.image].head<3>() - feature.unknown;
    const double std = std::sqrt(normal.featureCovariance(o.feature).trace());
    if (std < kLargestDepthError * from.norm()) continue;
    feature.used = false;
    rejected_.push_back({i, std / (kLargestDepthError * from.norm()) * kRejectionLimit, false});
    ++count;
  }
  return count;
}

std::size_t Snooping::reject(BundleProblem& problem, const BundleNormal& normal, double limit) {
  struct Found {
    std::size_t observation = 0, control = Observation::kNone, places = 0, wrong = 0;
    double value = 0.0, second = 0.0;
  };
  std::vector<Found> found(problem.features.size());
  std::vector<double> points, lines;
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    const Observation& o = problem.observations[i];
    if (!problem.inUse(o) || o.isPrior()) continue;
    const TestValue test = testOf(o, problem.linearised(o), normal);
    if (test.redundancy > kLeastRedundancy)
      (problem.features[o.feature].line ? lines : points).push_back(test.standardised);
    Found& here = found[o.feature];
    if (o.isControl()) here.control = i;
    if (!o.isControl()) ++here.places;
    if (!o.isControl() && test.standardised > kRejectionLimit) ++here.wrong;
    here.second = std::max(here.second, std::min(here.value, test.standardised));
    if (test.standardised <= here.value) continue;
    here.value = test.standardised;
    here.observation = i;
  }
  // Where the stated standard deviations are too small, residuals are judged by their scatter.
  constexpr double kMedian = 0.85;  // about that of the test values without blunders
  const auto scaleOf = [](std::vector<double>& values) {
    return values.size() < 20 ? 1.0 : std::max(1.0, medianInPlace(values) / kMedian);
  };
  const double point_scale = scaleOf(points), line_scale = scaleOf(lines);
  double greatest = 0.0;
  for (const Found& here : found) greatest = std::max(greatest, here.value);
  std::size_t count = 0;
  for (std::size_t f = 0; f < problem.features.size(); ++f) {
    const Found& here = found[f];
    const double scale = problem.features[f].line ? line_scale : point_scale;
    if (here.value <= std::max(limit * scale, kShareOfGreatest * greatest)) continue;
    const bool control = here.control != Observation::kNone && here.wrong >= kWrongPlaces &&
                         2 * here.wrong > here.places;
    const std::size_t which = control ? here.control : here.observation;
    Observation& o = problem.observations[which];
    const bool equal = here.second > kNearlyEqual * here.value && !o.isControl();
    rejected_.push_back({which, here.value / scale, !equal});
    o.used = false;
    if (equal) problem.features[f].used = false;
    ++count;
  }
  if (count == 0) count = rejectFarPoints(problem, normal);
  problem.dropWeakFeatures();
  return count;
}

void Snooping::describe(const BundleProblem& problem, BundleResult& result) const {
  for (const Rejected& rejected : rejected_) {
    const Observation& o = problem.observations[rejected.observation];
    const Feature& feature = problem.features[o.feature];
    Blunder blunder;
    if (!o.isControl()) blunder.image = problem.block.images[o.image].id;
    blunder.feature = feature.id;
    blunder.standardised = rejected.standardised;
    blunder.line = feature.line;
    blunder.localised = rejected.localised;
    if (o.isControl()) {
      const auto line =
          std::find_if(result.lines.begin(), result.lines.end(),
                       [&](const AdjustedLine& l) { return l.line.id == feature.id; });
      if (line != result.lines.end()) line->misfit = rejected.standardised;
    }
    result.blunders.push_back(blunder);
  }
  std::stable_sort(
      result.blunders.begin(), result.blunders.end(),
      [](const Blunder& a, const Blunder& b) { return a.standardised > b.standardised; });
}

}  // namespace pcl_als::photogrammetry
