// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <pcl_als/adjustment/clustered_regression.h>
#include <pcl_als/adjustment/correlated_errors.h>
#include <pcl_als/adjustment/robust_iteration.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {
namespace {

constexpr double kSingular = 1e-10;  // smallest eigenvalue of the scaled normal matrix
constexpr int kPasses = 10;          // they reach a thousandth of the standard deviation

/// Inverse of a symmetric matrix, scaled to a unit diagonal first; empty when it is singular.
Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& normal) {
  const Eigen::VectorXd diagonal = normal.diagonal();
  if (!(diagonal.minCoeff() > 0.0)) return {};
  const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  const auto eigen = symmetricEigen(scale.asDiagonal() * normal * scale.asDiagonal());
  if (eigen.values.minCoeff() < kSingular) return {};
  const Eigen::MatrixXd& v = eigen.vectors;
  return scale.asDiagonal() * v * eigen.values.cwiseInverse().asDiagonal() * v.transpose() *
         scale.asDiagonal();
}

/// Increases variances to at least these values, without a change of correlations.
void raiseTo(const Eigen::VectorXd& variances, Eigen::MatrixXd& covariance) {
  for (Eigen::Index i = 0; i < variances.size(); ++i) {
    const double found = covariance(i, i);
    if (!(found < variances[i])) continue;
    if (found > 0.0) {
      const double factor = std::sqrt(variances[i] / found);
      covariance.row(i) *= factor;
      covariance.col(i) *= factor;
    } else {
      covariance(i, i) = variances[i];
    }
  }
}

}  // namespace

double ClusteredRegression::Result::std(int unknown) const {
  return determined ? std::sqrt(std::max(0.0, covariance(unknown, unknown)))
                    : std::numeric_limits<double>::quiet_NaN();
}

double ClusteredRegression::Result::formalStd(int unknown) const {
  return determined ? std::sqrt(std::max(0.0, covariance_formal(unknown, unknown)))
                    : std::numeric_limits<double>::quiet_NaN();
}

ClusteredRegression::ClusteredRegression(int unknowns) : unknowns_(unknowns) {
  if (unknowns < 1 || unknowns > 6) throw UsageError("a regression has 1 to 6 unknowns");
}

void ClusteredRegression::add(std::int64_t cluster, const Row& row, double value) {
  if (row.size() != unknowns_) throw UsageError("a row has one entry for each unknown");
  rows_.insert(rows_.end(), row.data(), row.data() + unknowns_);
  values_.push_back(value);
  clusters_.push_back(cluster);
}

void ClusteredRegression::add(std::int64_t cluster, const Row& row, double value,
                              const Eigen::Vector2d& place, const Row& effect) {
  add(cluster, row, value);
  places_.push_back(place);
  effects_.insert(effects_.end(), effect.data(), effect.data() + effect.size());
}

void ClusteredRegression::raiseByCorrelation(const Eigen::VectorXd& weights,
                                             const Eigen::VectorXd& left, Result& result) const {
  if (places_.size() != values_.size()) return;
  const std::size_t components = effects_.size() / values_.size();
  CorrelatedErrors errors(unknowns_, static_cast<int>(components));
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Eigen::Map<const Row> effect(&effects_[i * components],
                                       static_cast<Eigen::Index>(components));
    errors.add(places_[i], rowOf(i), effect, weights[i], left[i]);
  }
  const CorrelatedErrors::Result shared = errors.solve();
  if (shared.determined) raiseTo(shared.covariance.diagonal(), result.covariance);
}

Eigen::VectorXd ClusteredRegression::residuals(const Eigen::VectorXd& estimate) const {
  Eigen::VectorXd left(values_.size());
  for (std::size_t i = 0; i < values_.size(); ++i) left[i] = values_[i] - rowOf(i).dot(estimate);
  return left;
}

ClusteredRegression::Result ClusteredRegression::solve(bool robust) const {
  Result result;
  const std::size_t n = values_.size();
  result.count = n;
  result.estimate = Eigen::VectorXd::Zero(unknowns_);
  if (n <= static_cast<std::size_t>(unknowns_)) return result;
  Eigen::MatrixXd inverse;
  RobustSettings settings;
  settings.most_passes = robust ? kPasses : 1;
  const RobustFit fit = fitRobustly(n, settings, [&](const auto& weights, auto& left) {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns_, unknowns_);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns_);
    left = residuals(result.estimate);
    for (std::size_t i = 0; i < n; ++i) {
      const double* const row = &rows_[i * unknowns_];
      for (int k = 0; k < unknowns_; ++k) {
        for (int j = k; j < unknowns_; ++j) normal(j, k) += weights[i] * row[j] * row[k];
        right[k] += weights[i] * left[i] * row[k];
      }
    }
    inverse = inverseOf(normal.selfadjointView<Eigen::Lower>());
    if (inverse.size() == 0) return std::optional<double>();
    const Eigen::VectorXd change = inverse * right;
    result.estimate += change;
    left = residuals(result.estimate);
    return std::optional<double>(change.dot(right));
  });
  if (!fit.solved()) return result;
  const Eigen::VectorXd &weights = fit.weights, &left = fit.residuals;
  std::map<std::int64_t, Row> scores;
  for (std::size_t i = 0; i < n; ++i) {
    const auto place = scores.try_emplace(clusters_[i], Row::Zero(unknowns_)).first;
    place->second += weights[i] * left[i] * rowOf(i);
  }
  result.clusters = scores.size();
  result.rms = std::sqrt(left.squaredNorm() / static_cast<double>(n));
  const auto fewest =
      std::max<std::size_t>(kFewestClusters, static_cast<std::size_t>(unknowns_) + 1);
  if (result.clusters < fewest) return result;
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(unknowns_, unknowns_);
  for (const auto& [cluster, score] : scores) middle += score * score.transpose();
  const double groups = static_cast<double>(result.clusters);
  result.covariance = groups / (groups - unknowns_) * inverse * middle * inverse;
  const double variance = left.cwiseProduct(weights).dot(left) / static_cast<double>(n - unknowns_);
  raiseTo(variance * inverse.diagonal(), result.covariance);
  result.covariance_formal = result.covariance;
  raiseByCorrelation(weights, left, result);
  result.determined = true;
  return result;
}

}  // namespace pcl_als
