// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <Eigen/Core>
#include <gtest/gtest.h>

#include <pcl_als/adjustment/dense_products.h>

namespace pcl_als {
namespace {

constexpr Eigen::Index kSize = 67;  // no multiple of the doubles of a register

/// Sums of products, without the kernels of Eigen.
Eigen::MatrixXd naiveProduct(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < b.cols(); ++j)
      for (Eigen::Index k = 0; k < a.cols(); ++k) product(i, j) += a(i, k) * b(k, j);
  return product;
}

Eigen::MatrixXd lowerOf(const Eigen::MatrixXd& matrix) {
  return matrix.triangularView<Eigen::Lower>();
}

/// Arguments are blocks of larger matrices, as in the factor of a sparse matrix.
struct DenseProducts : testing::Test {
  void SetUp() override {
    std::srand(1);
    left = Eigen::MatrixXd::Random(kSize + 5, kSize + 3);
    right = Eigen::MatrixXd::Random(kSize + 2, 41);
  }
  Eigen::MatrixXd left, right;
  // Sums of 67 products of numbers below one: 1e-16 times 67.
  const double rounding = 1e-13;
};

TEST_F(DenseProducts, MultiplyBlocks) {
  const auto a = left.block(1, 2, kSize, kSize);
  const auto b = right.topRows(kSize);
  Eigen::MatrixXd result = Eigen::MatrixXd::Constant(kSize + 4, b.cols(), 7.0);
  dense::multiply(a, b, result.middleRows(3, kSize));
  EXPECT_TRUE(result.middleRows(3, kSize).isApprox(naiveProduct(a, b), rounding));
  EXPECT_EQ(result(2, 0), 7.0);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Ones(kSize, b.cols());
  dense::addTransposedProduct(a, b, sum);
  const Eigen::MatrixXd expected = naiveProduct(a.transpose(), b).array() + 1.0;
  EXPECT_TRUE(sum.isApprox(expected, rounding));
}

TEST_F(DenseProducts, AddSquaresToTheLowerTriangle) {
  const auto a = left.block(1, 2, kSize, 32);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Ones(kSize, kSize);
  dense::addSquare(a, sum);
  const Eigen::MatrixXd square = naiveProduct(a, a.transpose()).array() + 1.0;
  EXPECT_TRUE(lowerOf(sum).isApprox(lowerOf(square), rounding));
  EXPECT_EQ(sum(0, kSize - 1), 1.0);
}

TEST_F(DenseProducts, SolveWithTheCholeskyFactor) {
  Eigen::MatrixXd matrix = naiveProduct(left, left.transpose());
  matrix.diagonal().array() += 10.0;
  Eigen::MatrixXd factor = matrix;
  ASSERT_TRUE(dense::factorise(factor));
  const Eigen::MatrixXd lower = lowerOf(factor);
  EXPECT_TRUE(naiveProduct(lower, lower.transpose()).isApprox(matrix, rounding));
  const Eigen::MatrixXd given = Eigen::MatrixXd::Random(matrix.rows(), 5);
  Eigen::MatrixXd solution = given;
  dense::solveLower(factor, solution);
  EXPECT_TRUE(naiveProduct(lower, solution).isApprox(given, rounding));
  Eigen::MatrixXd from_right = given.transpose();
  dense::solveLowerFromRight(factor, from_right);
  EXPECT_TRUE(naiveProduct(from_right, lower.transpose()).isApprox(given.transpose(), rounding));
}

TEST_F(DenseProducts, SayThatAMatrixIsNotPositive) {
  Eigen::MatrixXd matrix = -Eigen::MatrixXd::Identity(kSize, kSize);
  EXPECT_FALSE(dense::factorise(matrix));
}

}  // namespace
}  // namespace pcl_als
