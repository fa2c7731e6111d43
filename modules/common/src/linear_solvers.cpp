// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {

SymmetricEigen<Eigen::Dynamic> symmetricEigen(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricEigen<2> symmetricEigen2(const Eigen::Matrix2d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

namespace {

/// A unit vector that a singular symmetric matrix maps to zero.
Eigen::Vector3d nullVector(const Eigen::Matrix3d& matrix) {
  constexpr double kRankOne = 1e-24;  // of the fourth power of the longest column
  Eigen::Vector3d longest = matrix.col(0), best = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d normal = matrix.col(i).cross(matrix.col((i + 1) % 3));
    if (normal.squaredNorm() > best.squaredNorm()) best = normal;
    if (matrix.col(i).squaredNorm() > longest.squaredNorm()) longest = matrix.col(i);
  }
  const double square = longest.squaredNorm();
  if (best.squaredNorm() > kRankOne * square * square) return best.normalized();
  return square > 0.0 ? longest.unitOrthogonal() : Eigen::Vector3d::UnitZ();
}

}  // namespace

LeastEigen3 leastEigen3(const Eigen::Matrix3d& matrix) {
  const double mean = matrix.trace() / 3.0;
  Eigen::Matrix3d centred = matrix;
  centred.diagonal().array() -= mean;
  const double radius = std::sqrt(centred.squaredNorm() / 6.0);
  LeastEigen3 least{mean, mean, Eigen::Vector3d::UnitZ()};
  if (!(radius > 0.0)) return least;
  const double cosine = 0.5 * (centred / radius).determinant();  // of three times the angle
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) / 3.0;
  const double along = std::cos(angle), across = std::sqrt(3.0) * std::sin(angle);
  least.value = mean - radius * (along + across);
  least.middle_value = mean - radius * (along - across);
  Eigen::Matrix3d singular = matrix;
  singular.diagonal().array() -= least.value;
  least.vector = nullVector(singular);
  return least;
}

Eigen::VectorXd symmetricEigenvalues(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

Eigen::Vector2d symmetricEigenvalues2(const Eigen::Matrix2d& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

Eigen::VectorXd solveSymmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.ldlt().solve(right);
}

Eigen::MatrixXd inverseOfSymmetric(const Eigen::MatrixXd& matrix) {
  return LdltFactor(matrix).inverse();
}

Eigen::MatrixXd inverseOfRegular(const Eigen::MatrixXd& matrix) {
  return matrix.inverse();
}

Eigen::MatrixXd inverseOrEmpty(const Eigen::MatrixXd& matrix) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(matrix);
  if (!lu.isInvertible()) return {};
  return lu.inverse();
}

Eigen::MatrixXd inverseOfDefinite(const Eigen::MatrixXd& matrix) {
  constexpr double kSingular = 1e-12;  // of a matrix with unit diagonal
  if (!matrix.allFinite() || !(matrix.diagonal().array() > 0.0).all()) return {};
  const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const LdltFactor factor(scale.asDiagonal() * matrix * scale.asDiagonal());
  if (!factor.succeeded() || !(factor.diagonal().minCoeff() > kSingular)) return {};
  const Eigen::MatrixXd inverse = scale.asDiagonal() * factor.inverse() * scale.asDiagonal();
  return 0.5 * (inverse + inverse.transpose());
}

Eigen::MatrixXd orthogonalComplement(const Eigen::MatrixXd& design) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(design);
  const Eigen::MatrixXd orthogonal = qr.householderQ();
  return orthogonal.rightCols(design.rows() - qr.rank());
}

LdltFactor::LdltFactor(const Eigen::MatrixXd& matrix) : ldlt_(matrix) {}

bool LdltFactor::succeeded() const {
  return ldlt_.info() == Eigen::Success;
}

double LdltFactor::reciprocalCondition() const {
  return ldlt_.rcond();
}

Eigen::VectorXd LdltFactor::diagonal() const {
  return ldlt_.vectorD();
}

Eigen::MatrixXd LdltFactor::inverse() const {
  return ldlt_.solve(Eigen::MatrixXd::Identity(ldlt_.rows(), ldlt_.cols()));
}

CholeskyFactor::CholeskyFactor(const Eigen::MatrixXd& matrix) : llt_(matrix) {}

bool CholeskyFactor::succeeded() const {
  return llt_.info() == Eigen::Success;
}

Eigen::MatrixXd CholeskyFactor::lower() const {
  return llt_.matrixL();
}

double CholeskyFactor::logDeterminant() const {
  return 2.0 * llt_.matrixLLT().diagonal().array().log().sum();
}

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd& right) const {
  return llt_.solve(right);
}

Eigen::MatrixXd CholeskyFactor::solveLower(const Eigen::MatrixXd& right) const {
  return llt_.matrixL().solve(right);
}

Eigen::VectorXd CholeskyFactor::solveLower(const Eigen::VectorXd& right) const {
  return llt_.matrixL().solve(right);
}

Eigen::MatrixXd CholeskyFactor::solveUpper(const Eigen::MatrixXd& right) const {
  return llt_.matrixL().transpose().solve(right);
}

}  // namespace pcl_als
