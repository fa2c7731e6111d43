// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "chosen_parameters.h"

#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {

Eigen::MatrixXd sub(const SystemMatrix& matrix, const std::vector<SystemParameter>& chosen) {
  Eigen::MatrixXd part(chosen.size(), chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t j = 0; j < chosen.size(); ++j)
      part(i, j) = matrix(indexOf(chosen[i]), indexOf(chosen[j]));
  }
  return part;
}

SystemMatrix expanded(const Eigen::MatrixXd& part, const std::vector<SystemParameter>& chosen) {
  SystemMatrix matrix = SystemMatrix::Zero();
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t j = 0; j < chosen.size(); ++j)
      matrix(indexOf(chosen[i]), indexOf(chosen[j])) = part(i, j);
  }
  return matrix;
}

PriorChange::PriorChange(const BiasPrior& prior, const std::vector<SystemParameter>& chosen) {
  const BiasPrior of_chosen = prior.marginal(chosen);
  normal = of_chosen.information - prior.information;
  right = of_chosen.information * of_chosen.mean - prior.information * prior.mean;
}

SystemVector widePriorStd() {
  constexpr double kAngle = 0.5 * kRadiansPerDegree;
  SystemVector sigma;
  sigma << 1.0, 1.0, 1.0, kAngle, kAngle, kAngle, 1.0, 2e-3;
  return sigma;
}

bool invert(const Eigen::MatrixXd& matrix, Eigen::MatrixXd& inverse, double& log_determinant) {
  if (matrix.size() == 0 || !matrix.allFinite()) return false;
  if ((matrix.diagonal().array() <= 0.0).any()) return false;
  const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const LdltFactor ldlt(scale.asDiagonal() * matrix * scale.asDiagonal());
  constexpr double kSingular = 1e-11;  // of a matrix with unit diagonal
  if (!ldlt.succeeded() || ldlt.diagonal().minCoeff() < kSingular) return false;
  log_determinant = ldlt.diagonal().array().log().sum() - 2.0 * scale.array().log().sum();
  inverse = scale.asDiagonal() * ldlt.inverse() * scale.asDiagonal();
  return true;
}

}  // namespace pcl_als
