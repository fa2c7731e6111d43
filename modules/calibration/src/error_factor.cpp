// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "error_factor.h"

#include <vector>

namespace pcl_als {
namespace {

constexpr int kKnot = SharedErrors::kPerKnot;
constexpr Eigen::Index kLargestDense = 1500;

Eigen::SparseMatrix<double> sparse(const KnotBlocks& blocks, Eigen::Index size) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(blocks.size() * kKnot * kKnot);
  for (const auto& [knots, block] : blocks) {
    for (int r = 0; r < kKnot; ++r) {
      for (int c = 0; c < kKnot; ++c) {
        entries.emplace_back(knots.first * kKnot + r, knots.second * kKnot + c, block(r, c));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

ErrorFactor::ErrorFactor(const KnotBlocks& blocks, const Eigen::SparseMatrix<double>& prior,
                         Eigen::Index observed)
    : dense_(observed <= kLargestDense), observed_(observed) {
  if (!dense_) {
    ldlt_.compute(sparse(blocks, prior.rows()) + prior);
    return;
  }
  const Eigen::Index rest = prior.rows() - observed;
  Eigen::MatrixXd matrix = prior.topLeftCorner(observed, observed);
  for (const auto& [knots, block] : blocks) {
    matrix.block<kKnot, kKnot>(knots.first * kKnot, knots.second * kKnot) += block;
  }
  if (rest > 0) {
    coupling_ = prior.bottomLeftCorner(rest, observed);
    ldlt_.compute(prior.bottomRightCorner(rest, rest));
    matrix -= coupling_.transpose() * ldlt_.solve(Eigen::MatrixXd(coupling_));
  }
  cholesky_ = CholeskyFactor(matrix);
}

Eigen::MatrixXd ErrorFactor::solve(const Eigen::MatrixXd& right) const {
  if (!dense_) return ldlt_.solve(right);
  const Eigen::Index rest = right.rows() - observed_;
  if (rest == 0) return cholesky_.solve(right);
  const Eigen::MatrixXd own = ldlt_.solve(Eigen::MatrixXd(right.bottomRows(rest)));
  Eigen::MatrixXd solution(right.rows(), right.cols());
  solution.topRows(observed_) =
      cholesky_.solve(right.topRows(observed_) - coupling_.transpose() * own);
  solution.bottomRows(rest) =
      own - ldlt_.solve(Eigen::MatrixXd(coupling_ * solution.topRows(observed_)));
  return solution;
}

Eigen::MatrixXd ErrorFactor::quadraticForm(const Eigen::MatrixXd& right) const {
  if (!dense_) return right.transpose() * ldlt_.solve(right);
  const Eigen::MatrixXd half = cholesky_.solveLower(Eigen::MatrixXd(right.topRows(observed_)));
  return half.transpose() * half;
}

double ErrorFactor::logDeterminant() const {
  double sum = dense_ ? cholesky_.logDeterminant() : 0.0;
  if (ldlt_.rows() > 0) sum += ldlt_.vectorD().array().log().sum();
  return sum;
}

}  // namespace pcl_als
