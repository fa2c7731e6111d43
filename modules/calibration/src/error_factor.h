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
 * factorisation does several times faster; a large block stays sparse.
 */
class ErrorFactor {
 public:
  ErrorFactor(const KnotBlocks& blocks, const Eigen::SparseMatrix<double>& prior);

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  double logDeterminant() const;

 private:
  bool dense_;
  CholeskyFactor cholesky_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt_;
};

/// Logarithm of the determinant of a sparse symmetric matrix that is positive definite.
double sparseLogDeterminant(const Eigen::SparseMatrix<double>& matrix);

}  // namespace pcl_als
