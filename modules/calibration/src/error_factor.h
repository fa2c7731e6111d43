// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <map>
#include <utility>

#include <Eigen/SparseCholesky>

#include <pcl_als/calibration/shared_errors.h>
#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {

/// Normal matrix of the shared errors by pairs of knots, both orders of a pair.
using KnotBlocks = std::map<std::pair<int, int>,
                            Eigen::Matrix<double, SharedErrors::kPerKnot, SharedErrors::kPerKnot>>;

/** \brief Entries of the inverse of a symmetric matrix: all of a dense matrix, and those of a
 * sparse one at which its Cholesky factor may differ from zero (Takahashi, Fagan and Chin 1973).
 */
class InverseEntries {
 public:
  explicit InverseEntries(Eigen::MatrixXd all) : all_(std::move(all)) {}
  explicit InverseEntries(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& factor);

  /// The entry, which is zero outside the pattern of the factor.
  double operator()(Eigen::Index row, Eigen::Index column) const;
  /// The trace of the product of the inverse and a symmetric matrix within the pattern.
  double traceOfProduct(const Eigen::SparseMatrix<double>& matrix) const;
  double traceOfProduct(const KnotBlocks& blocks) const;

 private:
  Eigen::MatrixXd all_;
  // In the order of the sparse factor: the diagonal, and the lower triangle by columns.
  Eigen::VectorXi place_;
  Eigen::VectorXd diagonal_;
  Eigen::SparseMatrix<double> lower_;
};

/** \brief Cholesky factor of blocks + prior, for the elimination of the shared errors.
 *
 * In small blocks, knots of overlapping strips fill the factor almost entirely, and a dense
 * factorisation is several times faster; large blocks are factorised sparsely. Unknowns from \a
 * observed on occur in the prior only and are eliminated first in a small block.
 */
class ErrorFactor {
 public:
  ErrorFactor(const KnotBlocks& blocks, const Eigen::SparseMatrix<double>& prior,
              Eigen::Index observed);

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  InverseEntries inverse() const;
  double logDeterminant() const;

 private:
  bool dense_;
  Eigen::Index observed_;
  CholeskyFactor cholesky_;               ///< of the observed unknowns
  Eigen::SparseMatrix<double> coupling_;  ///< of the other unknowns with the observed ones
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt_;  ///< of the other unknowns, or of all
};

}  // namespace pcl_als
