// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/adjustment/correlated_errors.h>

namespace pcl_als {

/** \brief Linear least squares with a covariance that allows for correlated errors of neighbours.
 *
 * value = row . x + error. Errors of observations of one cluster (a patch of ground with common
 * terrain and common trajectory errors) may be correlated in any way, those of different clusters
 * are independent. With N = sum a'a and the score s_g = sum over cluster g of a' v,
 *   Cov = G/(G-m) N^-1 (sum_g s_g s_g') N^-1
 * (Liang and Zeger 1986) for G clusters and m unknowns; no variance is smaller than that of
 * independent errors, sigma^2 N^-1, because few clusters may agree by chance. Where places are
 * given, neighbouring clusters may have common errors (strips that deform along time). An error
 * common to all clusters (a constant error of a whole strip) is not included, because it is not
 * observable.
 *
 * Columns should be centred and scaled to about 1, so that N is well-conditioned. Deterministic:
 * sums are accumulated in the order of add().
 */
class ClusteredRegression {
 public:
  using Row = CorrelatedErrors::Row;

  /// \param unknowns 1 … 6
  explicit ClusteredRegression(int unknowns);

  void add(std::int64_t cluster, const Row& row, double value);
  /// At a plan position (metres): errors of clusters may then be correlated as well
  /// (CorrelatedErrors). \a effect: of the shared error, 1 for heights, the normal for distances
  /// along it. Either all observations have a place or none.
  void add(std::int64_t cluster, const Row& row, double value, const Eigen::Vector2d& place,
           const Row& effect = Row::Ones(1));
  std::size_t count() const { return values_.size(); }

  struct Result {
    bool determined = false;   ///< false: too few observations or clusters, or singular
    Eigen::VectorXd estimate;  ///< unknowns
    /// covariance_formal with each variance increased to that of errors which vary slowly over the
    /// ground (CorrelatedErrors), where places are known.
    Eigen::MatrixXd covariance;
    Eigen::MatrixXd covariance_formal;  ///< with independent clusters
    std::size_t count = 0, clusters = 0;
    double rms = 0.0;  ///< of the residuals

    double std(int unknown) const;
    double formalStd(int unknown) const;
  };
  /// \param robust gives residuals beyond 1.5 robust standard deviations less weight (Huber 1964),
  /// for surfaces with frequent outliers
  Result solve(bool robust = false) const;

  /// With fewer clusters the scatter between clusters is not determined.
  static constexpr std::size_t kFewestClusters = 3;

 private:
  Eigen::Map<const Row> rowOf(std::size_t i) const { return {&rows_[i * unknowns_], unknowns_}; }
  void raiseByCorrelation(const Eigen::VectorXd& weights, const Eigen::VectorXd& left,
                          Result& result) const;
  Eigen::VectorXd residuals(const Eigen::VectorXd& estimate) const;

  int unknowns_;
  std::vector<double> rows_, values_;
  std::vector<std::int64_t> clusters_;
  std::vector<Eigen::Vector2d> places_;
  std::vector<double> effects_;
};

}  // namespace pcl_als
