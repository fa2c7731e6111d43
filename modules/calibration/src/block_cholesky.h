// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "shared_errors.h"

namespace pcl_als {

/// Lower triangle of the normal matrix of the shared errors by pairs (row, column) of knots,
/// row >= column.
using KnotBlocks = std::map<std::pair<int, int>,
                            Eigen::Matrix<double, SharedErrors::kPerKnot, SharedErrors::kPerKnot>>;

/** \brief Lower triangle of a symmetric matrix of 6 x 6 blocks in an order of elimination, in
 * supernodes: successive block columns whose rows below the last of them are the same.
 */
class BlockColumns {
 public:
  static constexpr int kBlock = SharedErrors::kPerKnot;

  /// The pattern of the Cholesky factor of a matrix, whose blocks are eliminated in an order of
  /// approximate minimum degree.
  BlockColumns(const KnotBlocks& blocks, const Eigen::SparseMatrix<double>& prior);

  struct Supernode {
    int first = 0, count = 0;  ///< block columns
    std::vector<int> rows;     ///< block rows below, increasing
    /// kBlock columns for each block column; the rows of the block columns themselves, then rows.
    Eigen::MatrixXd panel;

    Eigen::Index width() const { return Eigen::Index{kBlock} * count; }
    Eigen::Index height() const { return Eigen::Index{kBlock} * static_cast<int>(rows.size()); }
    /// First row of the panel of a block row; -1: none.
    Eigen::Index rowOf(int block) const;
  };

  std::vector<Supernode> supernodes;
  std::vector<int> place;  ///< in the order of elimination, by block
  std::vector<int> owner;  ///< supernode of a block column

  /// Visits the blocks that two rows of a supernode have in later ones: \a visit(row, column,
  /// block) with indices into Supernode::rows, row >= column.
  template <class Visit>
  void visitPairs(const Supernode& from, const Visit& visit);

 private:
  void form(const std::vector<std::vector<int>>& rows);
};

/** \brief Entries of the inverse of a symmetric matrix, at which its Cholesky factor may differ
 * from zero (Takahashi, Fagan and Chin 1973). */
class InverseEntries {
 public:
  explicit InverseEntries(BlockColumns columns) : columns_(std::move(columns)) {}

  /// The entry, which is zero outside the pattern of the factor.
  double operator()(Eigen::Index row, Eigen::Index column) const;
  /// The same of two blocks.
  Eigen::Matrix<double, BlockColumns::kBlock, BlockColumns::kBlock> block(int row,
                                                                          int column) const;
  /// The trace of the product of the inverse and a symmetric matrix within the pattern.
  double traceOfProduct(const Eigen::SparseMatrix<double>& matrix) const;
  double traceOfProduct(const KnotBlocks& blocks) const;

 private:
  BlockColumns columns_;
};

/// Sparse Cholesky factor L L' of blocks + prior, by supernodes.
class BlockCholesky {
 public:
  BlockCholesky(const KnotBlocks& blocks, const Eigen::SparseMatrix<double>& prior);

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  double logDeterminant() const;
  /// The result does not depend on \a threads; 0: all cores.
  InverseEntries inverse(int threads = 0) const;

 private:
  void assemble(const KnotBlocks& blocks, const Eigen::SparseMatrix<double>& prior);
  void factorise();

  BlockColumns columns_;
};

}  // namespace pcl_als
