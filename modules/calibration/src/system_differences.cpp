// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The unknowns of systems after the first one in an Adjustment.
#include <algorithm>
#include <cmath>

#include "adjustment_reduced.h"
#include "chosen_parameters.h"

namespace pcl_als {
Eigen::VectorXd Adjustment::scatterVariance(const Influence& influence,
                                            const std::vector<SystemParameter>& estimate,
                                            const AreaResiduals& residuals) const {
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(influence.biases.cols());
  for (const Eigen::VectorXd& score : areaScores(influence, residuals))
    variance += score.cwiseAbs2();
  const Eigen::SparseMatrix<double> prior = errors_.priorInformation(levels_);
  const SystemMatrix known = errors_.model().biases.marginal(estimate).information;
  for (Eigen::Index i = 0; i < variance.size(); ++i) {
    variance[i] += influence.shared.col(i).dot(prior * influence.shared.col(i)) +
                   influence.biases.col(i).dot(known * influence.biases.col(i));
  }
  return variance;
}

SystemMatrix Adjustment::modelCovariance(const std::vector<SystemParameter>& estimate) const {
  Eigen::MatrixXd inverse;
  double ignored = 0.0;
  if (!invert(sub(normalOf(estimate), estimate), inverse, ignored)) return SystemMatrix::Zero();
  return expanded(inverse, estimate);
}

Adjustment::Influence Adjustment::differenceInfluence(int system, const SystemMatrix& model) const {
  const Eigen::Index at = Eigen::Index{errors_.systemBlock(system)} * SharedErrors::kPerKnot;
  const Eigen::Index column = at - Eigen::Index{errors_.systemBlock(1)} * SharedErrors::kPerKnot;
  Influence influence;
  influence.biases = -model * reduced_->elimination.middleRows<kSystemUnknownCount>(at).transpose();
  influence.shared = reduced_->with_systems.middleCols<kSystemUnknownCount>(column) -
                     reduced_->elimination * influence.biases;
  return influence;
}

std::vector<Adjustment::SystemPosterior> Adjustment::systemPosteriors(
    const std::vector<int>& systems, const std::vector<SystemParameter>& estimate,
    const AdjustmentSolution& solution) const {
  const SystemMatrix model = modelCovariance(estimate);
  const AreaResiduals residuals = areaResiduals(solution);
  std::vector<SystemPosterior> posteriors;
  for (const int system : systems) {
    const Eigen::Index at = Eigen::Index{errors_.systemBlock(system)} * SharedErrors::kPerKnot;
    const Influence influence = differenceInfluence(system, model);
    SystemPosterior& posterior = posteriors.emplace_back();
    posterior.mean = solution.shared.segment<kSystemUnknownCount>(at);
    const auto covariance = influence.shared.middleRows<kSystemUnknownCount>(at);
    posterior.covariance = 0.5 * (covariance + covariance.transpose());
    posterior.scatter = scatterVariance(influence, estimate, residuals);
  }
  return posteriors;
}

Adjustment::SystemSolution Adjustment::systemSolution(int system,
                                                      const std::vector<SystemParameter>& estimate,
                                                      const AdjustmentSolution& solution) const {
  constexpr int kUnknowns = kSystemUnknownCount;
  const Eigen::Index at = Eigen::Index{errors_.systemBlock(system)} * SharedErrors::kPerKnot;
  SystemSolution result;
  result.difference = solution.shared.segment<kUnknowns>(at);
  const SystemMatrix model = modelCovariance(estimate);
  const Influence on_difference = differenceInfluence(system, model);
  Influence on_own = on_difference;
  on_own.biases.leftCols<kSystemParameterCount>() += model;
  on_own.shared.leftCols<kSystemParameterCount>() -= reduced_->elimination * model;
  const AreaResiduals residuals = areaResiduals(solution);
  const Eigen::VectorXd scatter = scatterVariance(on_difference, estimate, residuals);
  const Eigen::VectorXd own_scatter = scatterVariance(on_own, estimate, residuals);
  for (int i = 0; i < kUnknowns; ++i) {
    const double variance = on_difference.shared(at + i, i);
    result.difference_std[i] = std::sqrt(std::max(variance, scatter[i]));
    result.std[i] = result.difference_std[i];
    if (i >= kSystemParameterCount) continue;
    // What made the standard deviation of the first system's parameter larger than the model's.
    const double factor =
        model(i, i) > 0.0 ? std::max(1.0, solution.covariance(i, i) / model(i, i)) : 1.0;
    const double own = on_own.biases(i, i) + on_own.shared(at + i, i);
    result.std[i] = std::sqrt(std::max(factor * own, own_scatter[i]));
  }
  return result;
}

}  // namespace pcl_als
