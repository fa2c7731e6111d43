// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <map>
#include <utility>

#include <Eigen/SparseCholesky>

#include <pcl_als/calibration/shared_errors.h>
#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {

/// The shared errors' own normal matrix by pairs of knots, both orders of a pair.
using KnotBlocks = std::map<std::pair<int, int>,
                            Eigen::Matrix<double, SharedErrors::kPerKnot, SharedErrors::kPerKnot>>;

/** \brief Cholesky factor of blocks + prior, for eliminating the shared errors.
 *
 * Knots of overlapping strips fill the factor of a small block almost entirely, which a dense
 * factorisation does several times faster; a large block stays sparse. Unknowns from \a observed on
 * occur in the prior only and are eliminated first in a small block, where they hardly add to the
 * cost.
 */
class ErrorFactor {
 public:
  ErrorFactor(const KnotBlocks& blocks, const Eigen::SparseMatrix<double>& prior,
              Eigen::Index observed);

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  /// right' M^-1 right of the factorised matrix M; \a right is zero from row \a observed on.
  Eigen::MatrixXd quadraticForm(const Eigen::MatrixXd& right) const;
  double logDeterminant() const;

 private:
  bool dense_;
  Eigen::Index observed_;
  CholeskyFactor cholesky_;                                  ///< the rest eliminated
  Eigen::SparseMatrix<double> coupling_;                     ///< of the rest with the observed
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt_;  ///< of the rest, or of everything
};

}  // namespace pcl_als
