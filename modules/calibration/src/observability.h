// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/calibration/flight_plan.h>

#include "block_facts.h"

namespace pcl_als {

/** \brief Information of a normal matrix about the parameters together (Habib et al. 2011, section
 * 2.2).
 *
 * Units are eliminated by the effect of each parameter on a ground point, see groundEffect().
 */
class Observability {
 public:
  /// \param normal N of all eight, shared errors eliminated, internal units
  /// (Adjustment::normalOf())
  /// \param wanted the parameters considered; the others are assumed to be known
  /// \param effect metres on the ground per internal unit of each parameter
  Observability(const SystemMatrix& normal, const std::vector<SystemParameter>& wanted,
                const SystemVector& effect);

  /// Enlarges every standard deviation by its factor, for a block whose scatter exceeds its model.
  void weaken(const SystemVector& factor);

  /// Largest first: the singular values of N, as standard deviations on the ground.
  std::vector<ParameterDirection> directions() const;
  /// Standard deviations with all considered parameters estimated and a prior standard deviation \a
  /// prior (internal units; infinite: no prior); infinite where a parameter is not determined, zero
  /// for the others.
  SystemVector deviations(const SystemVector& prior) const;
  /// Weakest first: parameters with correlations of 0.85 and more, and parameters beyond their
  /// limit.
  std::vector<WeakCombination> combinations(const BlockFacts& facts,
                                            const DeterminationLimits& limits) const;

  /// Effect of one internal unit of each parameter on a ground point at the edge of the swath,
  /// metres: the length of its column of Eq. (8).
  static SystemVector groundEffect(double height, double half_angle);

 private:
  struct Known;  // covariance of the parameters considered

  Eigen::MatrixXd scaledNormal() const;
  Known known(const SystemVector& prior) const;
  /// The parameter that can hardly be separated from \a i; \a i itself when there is none.
  std::size_t partnerOf(std::size_t i, const Known& known) const;
  WeakCombination single(std::size_t index, double std, const BlockFacts& facts) const;
  WeakCombination pair(std::size_t first, std::size_t second, double correlation,
                       const BlockFacts& facts) const;

  SystemMatrix normal_;
  std::vector<SystemParameter> wanted_;
  SystemVector effect_;
};

}  // namespace pcl_als
