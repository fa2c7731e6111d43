// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

namespace pcl_als {

/** \brief An unknown that may not exist: with a given probability it is exactly zero, otherwise it
 * has the prior N(0, prior) (spike and slab; Mitchell and Beauchamp 1988).
 *
 * With the observations its posterior under the prior is N(value, variance). The odds that it is
 * zero are the prior odds times the posterior over the prior density at zero (Savage-Dickey ratio;
 * Dickey 1971). If it is zero, an unknown x with covariance c to it changes by -c value / variance
 * and its variance decreases by c^2 / variance. The mean and the covariance of the mixture follow.
 */
class PossiblyAbsent {
 public:
  /// \param absent probability before the observations, [0, 1)
  PossiblyAbsent(double absent, double prior, double value, double variance);

  double probability() const { return probability_; }  ///< of absence, after the observations
  /// Change of unknowns with these covariances to it.
  Eigen::VectorXd move(const Eigen::VectorXd& covariances) const;
  /// Change of the covariance of such unknowns; mostly negative.
  Eigen::MatrixXd change(const Eigen::VectorXd& covariances) const;

 private:
  double value_, variance_, probability_;
};

}  // namespace pcl_als
