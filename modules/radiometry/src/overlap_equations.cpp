// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "overlap_equations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <pcl_als/common/linear_solvers.h>

namespace pcl_als::detail {
namespace {

/// A cell's mean has the variance of its points and as much again as of this many of them.
constexpr double kPointsOfTexture = 5.0;
constexpr double kSingleClusterFactor = 1e3;
constexpr double kSingular = 1e-11;  ///< smallest eigenvalue of the scaled normal matrix

double weightOf(double points) {
  return 2.0 * points / (points + kPointsOfTexture);
}

/// By how much deviations have to grow because they are found from scatter themselves: a variance
/// of n contributions m is known like one of 3 (sum m^2)^2 / sum m^4 - 2 degrees of freedom f, and
/// (x - true) / deviation then has the variance f / (f - 2) of Student's t.
/// \param squares, fourths sums of m^2 and m^4
Eigen::VectorXd scatterDoubt(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& fourths) {
  constexpr double kLeast = 4.0;
  const Eigen::ArrayXd freedom = (3.0 * squares.square() / fourths.max(1e-300) - 2.0).max(kLeast);
  return (freedom / (freedom - 2.0)).sqrt().matrix();
}

}  // namespace

struct OverlapEquations::Reduced {
  explicit Reduced(int n) : normal(Eigen::MatrixXd::Zero(n, n)), right(Eigen::VectorXd::Zero(n)) {}
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
};

OverlapEquations::OverlapEquations(const std::vector<SharedCell>& cells, double cell_size,
                                   const RadiometricModel& model, double cluster_size) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::uint32_t> numbers;
  const double per_cluster = std::max(1.0, cluster_size / cell_size);
  for (const SharedCell& cell : cells) {
    first_.push_back(rows_.size());
    const auto column = static_cast<std::int32_t>(std::floor(cell.column / per_cluster));
    const auto row = static_cast<std::int32_t>(std::floor(cell.row / per_cluster));
    const auto number = static_cast<std::uint32_t>(numbers.size());
    cluster_.push_back(numbers.try_emplace({column, row}, number).first->second);
    for (const SharedCell::View& view : cell.views) {
      const double given = std::log(view.intensity * model.factor(view.range, view.cosine));
      const double reference = model.reference_range;
      rows_.push_back({cluster_.size() - 1,
                       view.strip,
                       weightOf(view.points),
                       given,
                       {-std::log(view.range / reference), std::log(view.cosine),
                        -2.0 * (view.range - reference) / 1000.0}});
    }
  }
  first_.push_back(rows_.size());
  clusters_ = numbers.size();
  by_cluster_.resize(cells.size());
  std::iota(by_cluster_.begin(), by_cluster_.end(), std::size_t{0});
  std::stable_sort(by_cluster_.begin(), by_cluster_.end(),
                   [this](std::size_t a, std::size_t b) { return cluster_[a] < cluster_[b]; });
}

Eigen::VectorXd OverlapEquations::designOf(const OverlapUnknowns& unknowns, const Row& row) const {
  Eigen::VectorXd design = Eigen::VectorXd::Zero(unknowns.count);
  for (std::size_t t = 0; t < kRadiometricTermCount; ++t) {
    if (unknowns.term[t] >= 0) design[unknowns.term[t]] = row.effect[t];
  }
  const int gain = unknowns.gain[static_cast<std::size_t>(row.strip)];
  if (gain >= 0) design[gain] = 1.0;
  return design;
}

/// What the cells' reflectances and the unknowns do not explain if the former are zero.
Eigen::VectorXd OverlapEquations::remainders(const OverlapUnknowns& unknowns,
                                             const Eigen::VectorXd& x) const {
  Eigen::VectorXd left(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i)
    left[i] = rows_[i].given - designOf(unknowns, rows_[i]).dot(x);
  return left;
}

/// Adds a cell to normal equations with its reflectance eliminated: weighted deviations from its
/// means. \param factors on the weights of all rows
void OverlapEquations::addCell(const OverlapUnknowns& unknowns, std::size_t cell,
                               const Eigen::VectorXd& factors, const Eigen::VectorXd& values,
                               Reduced& reduced) const {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(unknowns.count);
  double sum = 0.0, value = 0.0;
  for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    const double weight = rows_[i].weight * factors[i];
    mean += weight * designOf(unknowns, rows_[i]);
    value += weight * values[i];
    sum += weight;
  }
  if (sum <= 0.0) return;
  mean /= sum;
  value /= sum;
  for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    const double weight = rows_[i].weight * factors[i];
    const Eigen::VectorXd design = designOf(unknowns, rows_[i]) - mean;
    reduced.normal.noalias() += weight * design * design.transpose();
    reduced.right += weight * (values[i] - value) * design;
  }
}

OverlapEquations::Reduced OverlapEquations::reduce(const OverlapUnknowns& unknowns,
                                                   const Eigen::VectorXd& factors,
                                                   const Eigen::VectorXd& values) const {
  Reduced reduced(unknowns.count);
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell)
    addCell(unknowns, cell, factors, values, reduced);
  return reduced;
}

/// Residuals, in standard deviations of unit weight: about the robust mean of their cell.
Eigen::VectorXd OverlapEquations::residuals(const Eigen::VectorXd& remainders,
                                            const Eigen::VectorXd& robust) const {
  Eigen::VectorXd residual(rows_.size());
  for (std::size_t cell = 0; cell + 1 < first_.size(); ++cell) {
    double sum = 0.0, mean = 0.0;
    for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      const double weight = rows_[i].weight * robust[i];
      mean += weight * remainders[i];
      sum += weight;
    }
    mean /= sum;
    const auto views = static_cast<double>(first_[cell + 1] - first_[cell]);
    // With two strips both residuals are half their difference, because the mean was estimated.
    const double inflated = std::sqrt(views / (views - 1.0));
    for (std::size_t i = first_[cell]; i < first_[cell + 1]; ++i)
      residual[i] = (remainders[i] - mean) * std::sqrt(rows_[i].weight) * inflated;
  }
  return residual;
}

/// Jackknife over clusters, one step each (CR3): where a few clusters (steep roofs) carry an
/// unknown, the plain sandwich is too narrow. What a small change of the unknowns does to the score
/// follows from residuals within the limit, because only these move it.
void OverlapEquations::covariances(const OverlapUnknowns& unknowns, const RobustFit& fit,
                                   OverlapSolution& solution) const {
  const int n = unknowns.count;
  const Eigen::VectorXd left = remainders(unknowns, solution.unknowns);
  const Eigen::VectorXd inside = fit.residuals.unaryExpr(
      [&](double r) { return std::abs(r) <= kHuberLimit * fit.scale ? 1.0 : 1e-9; });
  const Eigen::MatrixXd all = reduce(unknowns, inside, left).normal;
  solution.formal = fit.scale * fit.scale * inverseOfSymmetric(all);
  solution.covariance = Eigen::MatrixXd::Zero(n, n);
  Eigen::ArrayXd fourths = Eigen::ArrayXd::Zero(n);
  for (std::size_t at = 0; at < by_cluster_.size();) {
    const std::uint32_t cluster = cluster_[by_cluster_[at]];
    Reduced score(n), sensitivity(n);
    for (; at < by_cluster_.size() && cluster_[by_cluster_[at]] == cluster; ++at) {
      addCell(unknowns, by_cluster_[at], fit.weights, left, score);
      addCell(unknowns, by_cluster_[at], inside, left, sensitivity);
    }
    Eigen::VectorXd moved = solveSymmetric(all - sensitivity.normal, score.right);
    // An unknown determined by this cluster alone has no other estimate for comparison.
    if (!moved.allFinite()) moved.setConstant(kSingleClusterFactor);
    solution.covariance += moved * moved.transpose();
    fourths += moved.array().pow(4);
  }
  const auto clusters = static_cast<double>(clusters_);
  const Eigen::VectorXd doubt = scatterDoubt(solution.covariance.diagonal(), fourths);
  solution.covariance *= (clusters - 1.0) / clusters;
  solution.covariance = doubt.asDiagonal() * solution.covariance * doubt.asDiagonal();
}

OverlapSolution OverlapEquations::solve(const OverlapUnknowns& unknowns) const {
  OverlapSolution solution;
  solution.clusters = clusters_;
  solution.unknowns = Eigen::VectorXd::Zero(unknowns.count);
  if (unknowns.count == 0) {
    solution.covariance = solution.formal = Eigen::MatrixXd::Zero(0, 0);
    solution.outcome.end = RobustOutcome::End::converged;
    return solution;
  }
  const Eigen::VectorXd given = remainders(unknowns, solution.unknowns);
  const RobustFit fit = fitRobustly(rows_.size(), {}, [&](const auto& robust, auto& residual) {
    const Reduced reduced = reduce(unknowns, robust, given);
    const Eigen::VectorXd diagonal = reduced.normal.diagonal().cwiseSqrt().cwiseMax(1e-150);
    const Eigen::MatrixXd scaled = diagonal.cwiseInverse().asDiagonal() * reduced.normal *
                                   diagonal.cwiseInverse().asDiagonal();
    if (!(symmetricEigen(scaled).values[0] > kSingular)) return std::optional<double>();
    const Eigen::VectorXd next = solveSymmetric(reduced.normal, reduced.right);
    const Eigen::VectorXd change = next - std::exchange(solution.unknowns, next);
    residual = residuals(remainders(unknowns, next), robust);
    return std::optional<double>(change.dot(reduced.normal * change));
  });
  solution.outcome = fit;
  solution.sigma0 = fit.scale;
  if (fit.solved()) covariances(unknowns, fit, solution);
  return solution;
}

}  // namespace pcl_als::detail
