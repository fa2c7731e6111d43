// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Priors of the parameters in an Adjustment.
#include "adjustment_reduced.h"
#include "chosen_parameters.h"

namespace pcl_als {

SystemMatrix Adjustment::normalOf(const std::vector<SystemParameter>& estimate) const {
  return reduced_->normal + PriorChange(errors_.model().biases, estimate).normal;
}

SystemVector Adjustment::rightOf(const std::vector<SystemParameter>& estimate) const {
  return reduced_->right + PriorChange(errors_.model().biases, estimate).right;
}

AdjustmentSolution Adjustment::solveNearZero(const std::vector<SystemParameter>& estimate,
                                             const SystemVector& prior) const {
  AdjustmentSolution solution = unsolved(SystemVector::Zero());
  SystemMatrix normal = normalOf(estimate);
  normal.diagonal() += prior.cwiseAbs2().cwiseInverse();
  Eigen::MatrixXd inverse;
  double ignored = 0.0;
  if (!invert(sub(normal, estimate), inverse, ignored)) return solution;
  solution.covariance = solution.formal = expanded(inverse, estimate);
  solution.biases = solution.covariance * rightOf(estimate);
  solution.shared = reduced_->eliminated_right - reduced_->elimination * solution.biases;
  solution.solved = true;
  return solution;
}

}  // namespace pcl_als
