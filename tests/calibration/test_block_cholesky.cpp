// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "block_cholesky.h"

namespace pcl_als {
namespace {

constexpr int kBlock = BlockColumns::kBlock;

/// A positive definite matrix: observations that couple some blocks, and a prior that couples the
/// same component of successive blocks.
struct Matrix {
  KnotBlocks blocks;
  Eigen::SparseMatrix<double> prior;
  Eigen::MatrixXd dense;

  Matrix(int count, int observed, int observations, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const int size = kBlock * count;
    dense.setZero(size, size);
    for (int i = 0; i < observations; ++i) {
      const int a = static_cast<int>(random() % static_cast<unsigned>(observed));
      const int b = (a + static_cast<int>(random() % 4U)) % observed;
      Eigen::Matrix<double, 2 * kBlock, 1> row;
      for (double& value : row) value = normal(random);
      add(a, a, row.head<kBlock>() * row.head<kBlock>().transpose());
      add(b, b, row.tail<kBlock>() * row.tail<kBlock>().transpose());
      add(a, b, row.head<kBlock>() * row.tail<kBlock>().transpose());
      add(b, a, row.tail<kBlock>() * row.head<kBlock>().transpose());
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < size; ++i) {
      entries.emplace_back(i, i, 2.5 + 0.1 * std::abs(normal(random)));
      if (i < kBlock) continue;
      entries.emplace_back(i, i - kBlock, -1.0);
      entries.emplace_back(i - kBlock, i, -1.0);
    }
    prior.resize(size, size);
    prior.setFromTriplets(entries.begin(), entries.end());
    dense += Eigen::MatrixXd(prior);
  }
  void add(int a, int b, const Eigen::Matrix<double, kBlock, kBlock>& part) {
    if (a >= b) blocks.try_emplace({a, b}, KnotBlocks::mapped_type::Zero()).first->second += part;
    dense.block<kBlock, kBlock>(kBlock * a, kBlock * b) += part;
  }
};

class BlockCholeskyTest : public testing::TestWithParam<int> {};

// Rounding of matrices with a condition of about 1000.
constexpr double kRounding = 1e-11;

TEST_P(BlockCholeskyTest, EqualsADenseFactor) {
  const Matrix matrix(40, 30, GetParam(), 5);
  const BlockCholesky cholesky(matrix.blocks, matrix.prior);
  const Eigen::MatrixXd right = Eigen::MatrixXd::Random(matrix.dense.rows(), 3);
  EXPECT_LT((matrix.dense * cholesky.solve(right) - right).cwiseAbs().maxCoeff(), 1e-10);
  const Eigen::LLT<Eigen::MatrixXd> dense(matrix.dense);
  const double logarithm = 2.0 * dense.matrixLLT().diagonal().array().log().sum();
  EXPECT_NEAR(cholesky.logDeterminant(), logarithm, 1e-10 * std::abs(logarithm));
}

TEST_P(BlockCholeskyTest, GivesEntriesOfTheInverse) {
  const Matrix matrix(40, 30, GetParam(), 6);
  const InverseEntries entries = BlockCholesky(matrix.blocks, matrix.prior).inverse();
  const Eigen::MatrixXd inverse = matrix.dense.inverse();
  for (const auto& entry : matrix.blocks) {
    const auto [a, b] = entry.first;
    for (int r = 0; r < kBlock; ++r) {
      for (int c = 0; c < kBlock; ++c)
        EXPECT_NEAR(entries(kBlock * a + r, kBlock * b + c),
                    inverse(kBlock * a + r, kBlock * b + c), kRounding);
    }
  }
  EXPECT_NEAR(entries.traceOfProduct(matrix.prior), (matrix.prior * inverse).trace(), 1e-9);
  const Eigen::MatrixXd observed = matrix.dense - Eigen::MatrixXd(matrix.prior);
  EXPECT_NEAR(entries.traceOfProduct(matrix.blocks), (observed * inverse).trace(), 1e-9);
}

// Few couplings, some, and nearly all.
INSTANTIATE_TEST_SUITE_P(Density, BlockCholeskyTest, testing::Values(10, 60, 2000));

}  // namespace
}  // namespace pcl_als
