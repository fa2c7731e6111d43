// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Linear least squares whose covariance knows that neighbours err together.
 *
 * value = row . x + error. Errors of observations of one cluster (a patch of ground: one terrain,
 * one stretch of both trajectories) may be correlated in any way, those of different clusters are
 * independent. With N = sum a'a and the score s_g = sum over cluster g of a' v,
 *   Cov = G/(G-m) N^-1 (sum_g s_g s_g') N^-1
 * (Liang and Zeger 1986) for G clusters and m unknowns; no variance less than that of independent
 * errors, sigma^2 N^-1, for few clusters may happen to agree. What all clusters share (a constant
 * error of a whole strip) is not in it, because no observation shows it.
 *
 * Centre the columns: rows of size about 1 keep N well-conditioned. Deterministic: sums in the
 * order of add().
 */
class ClusteredRegression {
 public:
  /// \param unknowns 1 … 6
  explicit ClusteredRegression(int unknowns);

  void add(std::int64_t cluster, const Eigen::VectorXd& row, double value);
  std::size_t count() const { return values_.size(); }

  struct Result {
    bool determined = false;     ///< false: too few observations or clusters, or singular
    Eigen::VectorXd estimate;    ///< unknowns
    Eigen::MatrixXd covariance;  ///< of the estimate
    std::size_t count = 0, clusters = 0;
    double rms = 0.0;  ///< of the residuals

    double std(int unknown) const;
  };
  /// \param robust down-weights residuals beyond 1.5 robust sigma (Huber 1964), for surfaces where
  /// outliers are usual
  Result solve(bool robust = false) const;

  /// Fewer clusters say nothing of how clusters differ.
  static constexpr std::size_t kFewestClusters = 3;

 private:
  Eigen::VectorXd residuals(const Eigen::VectorXd& estimate) const;

  int unknowns_;
  std::vector<double> rows_, values_;
  std::vector<std::int64_t> clusters_;
};

}  // namespace pcl_als
