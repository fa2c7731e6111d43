// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "spike_and_slab.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {
namespace {

// Variance of an absent unknown over that of a present one, where the spike is zero.
constexpr double kNothing = 1e-12;

Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& matrix) {
  return CholeskyFactor(matrix).solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols()));
}

/// One combination of present and absent unknowns; in units of the slabs.
struct Combination {
  double weight = 0.0;     ///< at first the logarithm of the prior times the Occam factor
  double explained = 0.0;  ///< decrease of the sum of squares
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

bool isPresent(std::size_t set, Eigen::Index i) {
  return ((set >> i) & 1U) != 0;
}

Combination combination(std::size_t set, const std::vector<SpikeAndSlab::Prior>& priors,
                        Eigen::MatrixXd information, const Eigen::VectorXd& right) {
  Combination c;
  for (Eigen::Index i = 0; i < right.size(); ++i) {
    const SpikeAndSlab::Prior& prior = priors[static_cast<std::size_t>(i)];
    const bool present = isPresent(set, i);
    const double variance = present ? 1.0 : std::max(kNothing, prior.spike / prior.slab);
    const double probability = present ? 1.0 - prior.absent : prior.absent;
    information(i, i) += 1.0 / variance;
    c.weight += std::log(std::max(1e-300, probability)) - 0.5 * std::log(variance);
  }
  const CholeskyFactor factor(information);
  c.mean = factor.solve(right);
  c.covariance = factor.solve(Eigen::MatrixXd::Identity(right.size(), right.size()));
  c.weight -= 0.5 * factor.logDeterminant();
  c.explained = right.dot(c.mean);
  return c;
}

/// Logarithm of a likelihood ratio whose Gaussian value is half the difference of two sums of
/// squares, where their unit has been estimated: that of Student's t distribution.
double logRatio(double difference, double freedom) {
  if (std::isinf(freedom)) return 0.5 * difference;
  const double size = 0.5 * (freedom + 1.0) * std::log1p(std::abs(difference) / freedom);
  return std::copysign(size, difference);
}

/// Weights of sum one from logarithms. All combinations are compared with the most probable one.
void normalise(std::vector<Combination>& combinations, double freedom) {
  const double reference =
      std::max_element(combinations.begin(), combinations.end(),
                       [](const Combination& a, const Combination& b) {
                         return a.weight + 0.5 * a.explained < b.weight + 0.5 * b.explained;
                       })
          ->explained;
  for (Combination& c : combinations) c.weight += logRatio(c.explained - reference, freedom);
  double largest = combinations.front().weight, sum = 0.0;
  for (const Combination& c : combinations) largest = std::max(largest, c.weight);
  for (Combination& c : combinations) sum += (c.weight = std::exp(c.weight - largest));
  for (Combination& c : combinations) c.weight /= sum;
}

}  // namespace

SpikeAndSlab::SpikeAndSlab(const std::vector<Prior>& priors, const Eigen::VectorXd& mean,
                           const Eigen::MatrixXd& covariance, const Certainty& certainty) {
  const auto n = static_cast<Eigen::Index>(priors.size());
  // In units of the slabs, so that a prior of the slab is the identity matrix.
  Eigen::VectorXd unit(n);
  for (Eigen::Index i = 0; i < n; ++i)
    unit[i] = std::sqrt(priors[static_cast<std::size_t>(i)].slab);
  const Eigen::VectorXd per_unit = unit.cwiseInverse();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd inverse =
      inverseOf(per_unit.asDiagonal() * covariance * per_unit.asDiagonal());
  const Eigen::MatrixXd information = (inverse - identity) / certainty.overdispersion;
  const Eigen::VectorXd stated = per_unit.cwiseProduct(mean);
  const Eigen::VectorXd right = inverse * stated / certainty.overdispersion;
  std::vector<Combination> combinations;
  for (std::size_t set = 0; set < std::size_t{1} << priors.size(); ++set)
    combinations.push_back(combination(set, priors, information, right));
  normalise(combinations, certainty.freedom);

  Eigen::VectorXd mixed = Eigen::VectorXd::Zero(n), square = Eigen::VectorXd::Zero(n);
  presence_ = value_ = Eigen::VectorXd::Zero(n);
  for (std::size_t set = 0; set < combinations.size(); ++set) {
    const Combination& c = combinations[set];
    mixed += c.weight * c.mean;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!isPresent(set, i)) continue;
      presence_[i] += c.weight;
      value_[i] += c.weight * c.mean[i];
      square[i] += c.weight * (c.covariance(i, i) + c.mean[i] * c.mean[i]);
    }
  }
  const Eigen::VectorXd present = presence_.cwiseMax(1e-300);
  value_ = value_.cwiseQuotient(present).eval();
  const Eigen::VectorXd variance = square.cwiseQuotient(present) - value_.cwiseAbs2();
  std_ = variance.cwiseMax(0.0).cwiseSqrt().cwiseProduct(unit);
  value_ = value_.cwiseProduct(unit).eval();
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(n, n);
  for (const Combination& c : combinations) {
    const Eigen::VectorXd apart = c.mean - mixed;
    spread += c.weight * (c.covariance + apart * apart.transpose());
  }
  moved_ = per_unit.asDiagonal() * (inverse * (mixed - stated));
  changed_ =
      per_unit.asDiagonal() * (inverse * (spread * inverse - identity)) * per_unit.asDiagonal();
}

Eigen::VectorXd SpikeAndSlab::move(const Eigen::MatrixXd& covariances) const {
  return covariances * moved_;
}

Eigen::MatrixXd SpikeAndSlab::change(const Eigen::MatrixXd& covariances) const {
  return covariances * changed_ * covariances.transpose();
}

}  // namespace pcl_als
