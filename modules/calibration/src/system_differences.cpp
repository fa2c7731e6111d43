// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The unknowns of systems after the first one in an Adjustment.
#include <algorithm>
#include <cmath>

#include "adjustment_reduced.h"
#include "chosen_parameters.h"

namespace pcl_als {
namespace {

constexpr int kGlobal = kSystemParameterCount;

}  // namespace

Eigen::VectorXd Adjustment::scatterVariance(const Influence& influence,
                                            const AdjustmentSolution& solution) const {
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(influence.biases.cols());
  for (const Eigen::VectorXd& score : areaScores(influence, solution))
    variance += score.cwiseAbs2();
  const Eigen::SparseMatrix<double> prior = errors_.priorInformation(levels_);
  const SystemVector& known = errors_.model().biases.information;
  for (Eigen::Index i = 0; i < variance.size(); ++i) {
    variance[i] += influence.shared.col(i).dot(prior * influence.shared.col(i)) +
                   influence.biases.col(i).cwiseAbs2().dot(known);
  }
  return variance;
}

Adjustment::SystemSolution Adjustment::systemSolution(int system,
                                                      const std::vector<SystemParameter>& estimate,
                                                      const AdjustmentSolution& solution) const {
  constexpr int kUnknowns = kSystemUnknownCount;
  const Eigen::Index at = Eigen::Index{errors_.systemBlock(system)} * SharedErrors::kPerKnot;
  const Eigen::Index column = at - Eigen::Index{errors_.systemBlock(1)} * SharedErrors::kPerKnot;
  SystemSolution result;
  result.difference = solution.shared.segment<kUnknowns>(at);
  SystemMatrix model = SystemMatrix::Zero();
  Eigen::MatrixXd inverse;
  double ignored = 0.0;
  if (invert(sub(reduced_->normal, estimate), inverse, ignored))
    model = expanded(inverse, estimate);
  Influence on_difference;
  on_difference.biases = -model * reduced_->elimination.middleRows<kUnknowns>(at).transpose();
  on_difference.shared = reduced_->with_systems.middleCols<kUnknowns>(column) -
                         reduced_->elimination * on_difference.biases;
  Influence on_own = on_difference;
  on_own.biases.leftCols<kGlobal>() += model;
  on_own.shared.leftCols<kGlobal>() -= reduced_->elimination * model;
  const Eigen::VectorXd scatter = scatterVariance(on_difference, solution);
  const Eigen::VectorXd own_scatter = scatterVariance(on_own, solution);
  for (int i = 0; i < kUnknowns; ++i) {
    const double variance = on_difference.shared(at + i, i);
    result.difference_std[i] = std::sqrt(std::max(variance, scatter[i]));
    result.std[i] = result.difference_std[i];
    if (i >= kGlobal) continue;
    // What made the standard deviation of the first system's parameter larger than the model's.
    const double factor =
        model(i, i) > 0.0 ? std::max(1.0, solution.covariance(i, i) / model(i, i)) : 1.0;
    const double own = on_own.biases(i, i) + on_own.shared(at + i, i);
    result.std[i] = std::sqrt(std::max(factor * own, own_scatter[i]));
  }
  return result;
}

}  // namespace pcl_als
