// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Normal equations of unknowns in an order (of time) in which only neighbours are
 * connected, and of a few common unknowns that are connected with all of them.
 *
 * The matrix is [A F; F' G] with A banded (n x n, entries up to \a band beside the diagonal), F
 * (n x m) and G (m x m). A = L D L' is factorised within the band, the common unknowns are
 * eliminated last, and the elements of the inverse within the band follow from the recursion of
 * Takahashi (1973): time O(n band^2), memory O(n band). Covariances are those of the inverse, in
 * the units of the unknowns.
 */
class BandedNormal {
 public:
  /// \param unknowns n >= 1, \param band >= 0, \param common m >= 0
  BandedNormal(int unknowns, int band, int common);

  int unknowns() const { return n_; }
  int band() const { return band_; }
  int common() const { return m_; }

  void setZero();
  /// Adds to the element (i, j) and with it to (j, i); |i - j| <= band().
  void add(int i, int j, double value) { matrix_[i >= j ? at(i, j) : at(j, i)] += value; }
  void addRight(int i, double value) { right_[i] += value; }
  void addBorder(int i, int common, double value) { border_(i, common) += value; }
  void addCorner(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

  /// Factorises, solves and computes the inverse within the band; false (and nothing else) where
  /// the matrix is not positive definite.
  bool solve();

  const Eigen::VectorXd& solution() const { return solution_; }  ///< n, after solve()
  const Eigen::VectorXd& commonSolution() const { return common_solution_; }
  /// Element of the inverse for |i - j| <= band().
  double covariance(int i, int j) const;
  /// Of the common unknowns, m x m.
  const Eigen::MatrixXd& commonCovariance() const { return corner_inverse_; }

 private:
  /// Element (i, j), i >= j, of the lower band.
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(band_ + 1) +
           static_cast<std::size_t>(i - j);
  }
  bool factorise();
  void solveInPlace(Eigen::Ref<Eigen::VectorXd> right) const;
  bool eliminateCommon();
  void invert();

  int n_, band_, m_;
  bool connected_ = true;                          ///< the common unknowns with the others
  std::vector<double> matrix_, factor_, inverse_;  ///< lower bands; factor_: D on the diagonal
  Eigen::VectorXd right_, corner_right_, solution_, common_solution_;
  Eigen::MatrixXd border_, corner_, reach_, corner_inverse_;  ///< reach_: A^-1 F
};

}  // namespace pcl_als
