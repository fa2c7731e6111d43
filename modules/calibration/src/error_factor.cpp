// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "error_factor.h"

#include <algorithm>
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

/// (L L')^-1, by blocks from the last: with the part W of the inverse that is known, and the
/// columns (D, B) of L on and below the diagonal of the next block, Y = B D^-1, the inverse's
/// columns are
/// ((D D')^-1 + Y' W Y, -W Y).
Eigen::MatrixXd inverseFromFactor(const Eigen::MatrixXd& lower) {
  constexpr Eigen::Index kBlock = 64;
  const Eigen::Index size = lower.rows();
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index end = size; end > 0;) {
    const Eigen::Index begin = std::max<Eigen::Index>(0, end - kBlock);
    const Eigen::Index width = end - begin, known = size - end;
    const auto triangle = lower.block(begin, begin, width, width).triangularView<Eigen::Lower>();
    const Eigen::MatrixXd own = triangle.solve(Eigen::MatrixXd::Identity(width, width));
    const Eigen::MatrixXd ratio = lower.block(end, begin, known, width) * own;
    const Eigen::MatrixXd product = inverse.bottomRightCorner(known, known) * ratio;
    inverse.block(end, begin, known, width) = -product;
    inverse.block(begin, end, width, known) = -product.transpose();
    inverse.block(begin, begin, width, width) = own.transpose() * own + ratio.transpose() * product;
    end = begin;
  }
  return inverse;
}

}  // namespace

InverseEntries::InverseEntries(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& factor)
    : place_(factor.permutationP().indices()),
      diagonal_(factor.vectorD().cwiseInverse()),
      lower_(factor.matrixL().nestedExpression()) {
  // Column j of the inverse Z of L D L' below the diagonal is -Z l_j, with the column l_j of L, and
  // needs entries of Z in the rows of l_j only. The pattern of L contains them.
  const Eigen::Index size = lower_.cols();
  Eigen::VectorXd l = Eigen::VectorXd::Zero(size), sum = Eigen::VectorXd::Zero(size);
  std::vector<bool> used(static_cast<std::size_t>(size), false);
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  for (Eigen::Index column = size - 1; column >= 0; --column) {
    for (Entry entry(lower_, column); entry; ++entry) {
      l[entry.row()] = entry.value();
      used[static_cast<std::size_t>(entry.row())] = true;
    }
    for (Entry entry(lower_, column); entry; ++entry) {
      const Eigen::Index k = entry.row();
      double own = diagonal_[k] * l[k];
      for (Entry z(lower_, k); z; ++z) {
        if (!used[static_cast<std::size_t>(z.row())]) continue;
        own += z.value() * l[z.row()];
        sum[z.row()] += z.value() * l[k];
      }
      sum[k] += own;
    }
    for (Entry entry(lower_, column); entry; ++entry) {
      const Eigen::Index row = entry.row();
      diagonal_[column] += l[row] * sum[row];
      entry.valueRef() = -sum[row];
      sum[row] = 0.0;
      used[static_cast<std::size_t>(row)] = false;
    }
  }
}

double InverseEntries::operator()(Eigen::Index row, Eigen::Index column) const {
  if (all_.size() > 0) return all_(row, column);
  const int a = place_[row], b = place_[column];
  return a == b ? diagonal_[a] : lower_.coeff(std::max(a, b), std::min(a, b));
}

double InverseEntries::traceOfProduct(const Eigen::SparseMatrix<double>& matrix) const {
  double trace = 0.0;
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry)
      trace += entry.value() * (*this)(entry.row(), column);
  }
  return trace;
}

double InverseEntries::traceOfProduct(const KnotBlocks& blocks) const {
  double trace = 0.0;
  for (const auto& [knots, block] : blocks) {
    for (int c = 0; c < kKnot; ++c) {
      for (int r = 0; r < kKnot; ++r)
        trace += block(r, c) * (*this)(knots.first * kKnot + r, knots.second * kKnot + c);
    }
  }
  return trace;
}

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

InverseEntries ErrorFactor::inverse() const {
  if (!dense_) return InverseEntries(ldlt_);
  const Eigen::MatrixXd own = inverseFromFactor(cholesky_.lower());
  const Eigen::Index rest = coupling_.rows();
  if (rest == 0) return InverseEntries(own);
  // The other unknowns are R^-1 (h - C x) of the observed ones x, with the information R of theirs
  // and the coupling C.
  const Eigen::SparseMatrix<double> effect =
      (-ldlt_.solve(Eigen::MatrixXd(coupling_))).sparseView();
  Eigen::MatrixXd all(observed_ + rest, observed_ + rest);
  all.topLeftCorner(observed_, observed_) = own;
  all.bottomLeftCorner(rest, observed_) = effect * own;
  all.topRightCorner(observed_, rest) = all.bottomLeftCorner(rest, observed_).transpose();
  all.bottomRightCorner(rest, rest) =
      effect * all.topRightCorner(observed_, rest) +
      ldlt_.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(rest, rest)));
  return InverseEntries(std::move(all));
}

double ErrorFactor::logDeterminant() const {
  double sum = dense_ ? cholesky_.logDeterminant() : 0.0;
  if (ldlt_.rows() > 0) sum += ldlt_.vectorD().array().log().sum();
  return sum;
}

}  // namespace pcl_als
