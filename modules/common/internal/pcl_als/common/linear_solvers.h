// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace pcl_als {

// Decompositions of dense matrices behind ordinary functions: a source that instantiates Eigen's
// templates takes the compiler 5 to 20 s longer, and so many do.

/// Eigenvalues of a symmetric matrix in increasing order; column i is the unit eigenvector of
/// values[i].
template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// By tridiagonalisation and QR iterations; only the lower triangle is read.
SymmetricEigen<Eigen::Dynamic> symmetricEigen(const Eigen::MatrixXd& matrix);
SymmetricEigen<2> symmetricEigen2(const Eigen::Matrix2d& matrix);

/// The least eigenvalue of a symmetric matrix with its unit eigenvector, and the next eigenvalue.
struct LeastEigen3 {
  double value = 0.0, middle_value = 0.0;
  Eigen::Vector3d vector = Eigen::Vector3d::UnitZ();
};
/// By the trigonometric solution of the characteristic equation: a tenth of the time of iterations,
/// with half as many valid digits of the eigenvector where the two values are nearly equal.
LeastEigen3 leastEigen3(const Eigen::Matrix3d& matrix);

/// The eigenvalues alone, in increasing order.
Eigen::VectorXd symmetricEigenvalues(const Eigen::MatrixXd& matrix);
Eigen::Vector2d symmetricEigenvalues2(const Eigen::Matrix2d& matrix);

/// x of matrix x = right for a symmetric matrix, by LDLᵀ with pivots; it may be semidefinite.
Eigen::VectorXd solveSymmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// Inverse of a symmetric matrix by LDLᵀ with pivots.
Eigen::MatrixXd inverseOfSymmetric(const Eigen::MatrixXd& matrix);

/// Inverse of a regular matrix by LU with partial pivots.
Eigen::MatrixXd inverseOfRegular(const Eigen::MatrixXd& matrix);

/// Inverse by LU with complete pivots; empty (0 x 0) for a matrix that is numerically singular.
Eigen::MatrixXd inverseOrEmpty(const Eigen::MatrixXd& matrix);

/// Inverse of a symmetric positive definite matrix whose rows may have different units, by LDLᵀ of
/// the matrix scaled to unit diagonal; empty (0 x 0) for one that is not, or that is not finite.
Eigen::MatrixXd inverseOfDefinite(const Eigen::MatrixXd& matrix);

/// Orthonormal columns that span what no linear combination of the columns of \a design reaches, by
/// QR with pivots: n rows and n - rank(design) columns.
Eigen::MatrixXd orthogonalComplement(const Eigen::MatrixXd& design);

/// LDLᵀ factor of a symmetric matrix.
class LdltFactor {
 public:
  explicit LdltFactor(const Eigen::MatrixXd& matrix);
  bool succeeded() const;
  double reciprocalCondition() const;  ///< estimate; about 0: singular
  Eigen::VectorXd diagonal() const;    ///< of D
  Eigen::MatrixXd inverse() const;

 private:
  Eigen::LDLT<Eigen::MatrixXd> ldlt_;
};

/// Cholesky factor L Lᵀ of a symmetric positive definite matrix.
class CholeskyFactor {
 public:
  CholeskyFactor() = default;
  explicit CholeskyFactor(const Eigen::MatrixXd& matrix);
  bool succeeded() const;  ///< false: the matrix is not positive definite
  Eigen::MatrixXd lower() const;
  double logDeterminant() const;  ///< of the matrix
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  Eigen::MatrixXd solveLower(const Eigen::MatrixXd& right) const;  ///< x of L x = right
  Eigen::VectorXd solveLower(const Eigen::VectorXd& right) const;
  Eigen::MatrixXd solveUpper(const Eigen::MatrixXd& right) const;  ///< x of Lᵀ x = right

 private:
  Eigen::LLT<Eigen::MatrixXd> llt_;
};

}  // namespace pcl_als
