// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Unknowns each of which may be absent: with a given probability it has the prior
 * N(0, spike), otherwise N(0, slab) (spike and slab; Mitchell and Beauchamp 1988, JASA 83). A spike
 * of zero means that an absent unknown does not exist.
 *
 * The posterior of the unknowns under the slabs, N(mean, covariance), holds all that the
 * observations say about them. For each of the 2^n combinations the marginal likelihood and the
 * posterior follow in closed form (Savage-Dickey ratio, Dickey 1971, for several unknowns); mean
 * and covariance are those of the mixture.
 */
class SpikeAndSlab {
 public:
  struct Prior {
    double absent = 0.5;  ///< probability before the observations, [0, 1)
    double spike = 0.0;   ///< variance where it is absent
    double slab = 1.0;    ///< variance where it is present, > spike
  };

  /// What is known of the certainty of the observations.
  struct Certainty {
    /// Factor >= 1 by which their covariance is larger than stated.
    double overdispersion = 1.0;
    /// Degrees of freedom of its estimate. With few of them the likelihood ratio to the most
    /// probable combination is that of Student's t distribution instead of the normal distribution.
    double freedom = std::numeric_limits<double>::infinity();
  };
  /// \param mean and \param covariance posterior with all priors at their slabs; n <= 12.
  SpikeAndSlab(const std::vector<Prior>& priors, const Eigen::VectorXd& mean,
               const Eigen::MatrixXd& covariance, const Certainty& certainty);
  SpikeAndSlab(const std::vector<Prior>& priors, const Eigen::VectorXd& mean,
               const Eigen::MatrixXd& covariance)
      : SpikeAndSlab(priors, mean, covariance, Certainty()) {}

  /// Probability that each is present, given the observations.
  const Eigen::VectorXd& presence() const { return presence_; }
  /// Mean and standard deviation of each, given that it is present.
  const Eigen::VectorXd& valueIfPresent() const { return value_; }
  const Eigen::VectorXd& stdIfPresent() const { return std_; }

  /// Change of the mean of other unknowns, which have these covariances (rows) to the unknowns
  /// under the slabs, from the slabs to the mixture.
  Eigen::VectorXd move(const Eigen::MatrixXd& covariances) const;
  /// The same for their covariance; mostly negative.
  Eigen::MatrixXd change(const Eigen::MatrixXd& covariances) const;

 private:
  Eigen::VectorXd presence_, value_, std_;
  Eigen::VectorXd moved_;    ///< C^-1 (mean of the mixture - mean)
  Eigen::MatrixXd changed_;  ///< C^-1 (covariance of the mixture - C) C^-1
};

}  // namespace pcl_als
