// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/adjustment/banded_normal.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {

BandedNormal::BandedNormal(int unknowns, int band, int common)
    : n_(unknowns), band_(std::min(band, unknowns - 1)), m_(common) {
  if (unknowns < 1 || band < 0 || common < 0)
    throw UsageError("banded normal equations: negative size");
  setZero();
}

void BandedNormal::setZero() {
  matrix_.assign(static_cast<std::size_t>(n_) * static_cast<std::size_t>(band_ + 1), 0.0);
  right_ = Eigen::VectorXd::Zero(n_);
  border_ = Eigen::MatrixXd::Zero(n_, m_);
  corner_ = Eigen::MatrixXd::Zero(m_, m_);
  corner_right_ = Eigen::VectorXd::Zero(m_);
}

void BandedNormal::addCorner(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  corner_ += matrix;
  corner_right_ += right;
}

bool BandedNormal::factorise() {
  constexpr double kSingular = 1e-13;  // of the diagonal element before elimination
  factor_ = matrix_;
  for (int i = 0; i < n_; ++i) {
    const int first = std::max(0, i - band_);
    // Row i of L times D, then of L.
    for (int j = first; j < i; ++j) {
      double sum = factor_[at(i, j)];
      for (int k = std::max(first, j - band_); k < j; ++k)
        sum -= factor_[at(i, k)] * factor_[at(j, k)];
      factor_[at(i, j)] = sum;
    }
    double pivot = factor_[at(i, i)];
    for (int j = first; j < i; ++j) {
      const double scaled = factor_[at(i, j)] / factor_[at(j, j)];
      pivot -= scaled * factor_[at(i, j)];
      factor_[at(i, j)] = scaled;
    }
    if (!(pivot > kSingular * matrix_[at(i, i)])) return false;
    factor_[at(i, i)] = pivot;
  }
  return true;
}

void BandedNormal::solveInPlace(Eigen::Ref<Eigen::VectorXd> right) const {
  for (int i = 0; i < n_; ++i)
    for (int j = std::max(0, i - band_); j < i; ++j) right[i] -= factor_[at(i, j)] * right[j];
  for (int i = 0; i < n_; ++i) right[i] /= factor_[at(i, i)];
  for (int i = n_ - 1; i >= 0; --i)
    for (int j = std::max(0, i - band_); j < i; ++j) right[j] -= factor_[at(i, j)] * right[i];
}

bool BandedNormal::eliminateCommon() {
  solution_ = right_;
  solveInPlace(solution_);
  common_solution_ = Eigen::VectorXd::Zero(m_);
  if (m_ == 0) return true;
  reach_ = border_;
  connected_ = !border_.isZero(0.0);
  for (int c = 0; c < m_; ++c) solveInPlace(reach_.col(c));
  const CholeskyFactor reduced(corner_ - border_.transpose() * reach_);
  if (!reduced.succeeded()) return false;
  corner_inverse_ = reduced.solve(Eigen::MatrixXd::Identity(m_, m_));
  common_solution_ = corner_inverse_ * (corner_right_ - border_.transpose() * solution_);
  solution_ -= reach_ * common_solution_;
  return true;
}

/// Takahashi's recursion, from the last unknown to the first.
void BandedNormal::invert() {
  inverse_.assign(matrix_.size(), 0.0);
  const auto element = [this](int i, int j) -> double& {
    return inverse_[i >= j ? at(i, j) : at(j, i)];
  };
  for (int j = n_ - 1; j >= 0; --j) {
    const int last = std::min(n_ - 1, j + band_);
    for (int i = last; i >= j; --i) {
      double value = i == j ? 1.0 / factor_[at(j, j)] : 0.0;
      for (int k = j + 1; k <= last; ++k) value -= factor_[at(k, j)] * element(i, k);
      element(i, j) = value;
    }
  }
}

bool BandedNormal::solve() {
  if (!factorise() || !eliminateCommon()) return false;
  invert();
  return true;
}

double BandedNormal::covariance(int i, int j) const {
  const double own = inverse_[i >= j ? at(i, j) : at(j, i)];
  if (m_ == 0 || !connected_) return own;
  return own + reach_.row(i).dot(corner_inverse_ * reach_.row(j).transpose());
}

}  // namespace pcl_als
