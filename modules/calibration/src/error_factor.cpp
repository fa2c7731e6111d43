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

ErrorFactor::ErrorFactor(const KnotBlocks& blocks, const Eigen::SparseMatrix<double>& prior)
    : dense_(prior.rows() <= kLargestDense) {
  if (!dense_) {
    ldlt_.compute(sparse(blocks, prior.rows()) + prior);
    return;
  }
  Eigen::MatrixXd matrix = prior;
  for (const auto& [knots, block] : blocks) {
    matrix.block<kKnot, kKnot>(knots.first * kKnot, knots.second * kKnot) += block;
  }
  cholesky_ = CholeskyFactor(matrix);
}

Eigen::MatrixXd ErrorFactor::solve(const Eigen::MatrixXd& right) const {
  if (dense_) return cholesky_.solve(right);
  return ldlt_.solve(right);
}

double ErrorFactor::logDeterminant() const {
  return dense_ ? cholesky_.logDeterminant() : ldlt_.vectorD().array().log().sum();
}

double sparseLogDeterminant(const Eigen::SparseMatrix<double>& matrix) {
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).vectorD().array().log().sum();
}

}  // namespace pcl_als
