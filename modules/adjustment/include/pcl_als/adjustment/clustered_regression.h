// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Linear least squares with a covariance that allows for correlated errors of neighbours.
 *
 * value = row . x + error. Errors of observations of one cluster (a patch of ground: one terrain,
 * one stretch of both trajectories) may be correlated in any way, those of different clusters are
 * independent. With N = sum a'a and the score s_g = sum over cluster g of a' v,
 *   Cov = G/(G-m) N^-1 (sum_g s_g s_g') N^-1
 * (Liang and Zeger 1986) for G clusters and m unknowns; no variance less than that of independent
 * errors, sigma^2 N^-1, because few clusters may agree by chance. Where places are given, clusters
 * near each other may have common errors: the strips deform along time. What all clusters share (a
 * constant error of a whole strip) is not in it, because it is not observable.
 *
 * Centre the columns: rows of size about 1 keep N well-conditioned. Deterministic: sums in the
 * order of add().
 */
class ClusteredRegression {
 public:
  /// \param unknowns 1 … 6
  explicit ClusteredRegression(int unknowns);

  void add(std::int64_t cluster, const Eigen::VectorXd& row, double value);
  /// At a plan position (metres): errors of clusters may then be correlated as well
  /// (CorrelatedErrors). \a effect: of the shared error, 1 for heights, the normal for distances
  /// along it. All observations have a place, or none.
  void add(std::int64_t cluster, const Eigen::VectorXd& row, double value,
           const Eigen::Vector2d& place, const Eigen::VectorXd& effect = Eigen::VectorXd::Ones(1));
  std::size_t count() const { return values_.size(); }

  struct Result {
    bool determined = false;   ///< false: too few observations or clusters, or singular
    Eigen::VectorXd estimate;  ///< unknowns
    /// Of the estimate: covariance_formal, with each variance raised to that of errors which vary
    /// slowly over the ground (CorrelatedErrors) where places are known.
    Eigen::MatrixXd covariance;
    Eigen::MatrixXd covariance_formal;  ///< clusters are independent
    std::size_t count = 0, clusters = 0;
    double rms = 0.0;  ///< of the residuals

    double std(int unknown) const;
    double formalStd(int unknown) const;
  };
  /// \param robust down-weights residuals beyond 1.5 robust sigma (Huber 1964), for surfaces where
  /// outliers are usual
  Result solve(bool robust = false) const;

  /// With fewer clusters the scatter between clusters is not determined.
  static constexpr std::size_t kFewestClusters = 3;

 private:
  void raiseByCorrelation(const Eigen::VectorXd& weights, const Eigen::VectorXd& left,
                          Result& result) const;
  Eigen::VectorXd residuals(const Eigen::VectorXd& estimate) const;

  int unknowns_;
  std::vector<double> rows_, values_;
  std::vector<std::int64_t> clusters_;
  std::vector<Eigen::Vector2d> places_;
  std::vector<Eigen::VectorXd> effects_;
};

}  // namespace pcl_als
