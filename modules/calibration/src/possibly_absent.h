// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

namespace pcl_als {

/** \brief An unknown that may not exist: with a given probability it is exactly zero, else it is as
 * its prior N(0, prior) says (spike and slab; Mitchell and Beauchamp 1988).
 *
 * Observations together with the prior made it N(value, variance). The odds that it is zero are
 * those before times the posterior over the prior density at zero (Savage-Dickey ratio; Dickey
 * 1971). Given that it is zero, an unknown x with covariance c to it moves by -c value / variance
 * and its variance falls by c^2 / variance. What follows is the mean and the covariance of both.
 */
class PossiblyAbsent {
 public:
  /// \param absent probability before the observations, [0, 1)
  PossiblyAbsent(double absent, double prior, double value, double variance);

  double probability() const { return probability_; }  ///< of absence, after the observations
  /// By which unknowns with these covariances to it move.
  Eigen::VectorXd move(const Eigen::VectorXd& covariances) const;
  /// What is added to the covariance of such unknowns; mostly negative.
  Eigen::MatrixXd change(const Eigen::VectorXd& covariances) const;

 private:
  double value_, variance_, probability_;
};

}  // namespace pcl_als
