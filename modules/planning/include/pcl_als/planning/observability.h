// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/calibration/parameter_choice.h>
#include <pcl_als/planning/block_facts.h>

namespace pcl_als {

/// One direction in the space of parameters and its standard deviation.
struct ParameterDirection {
  /// A unit vector; each parameter is expressed by its effect on a ground point, so that equal
  /// components have equal effects.
  SystemVector components = SystemVector::Zero();
  double std = 0.0;  ///< along the direction, metres on the ground; infinite without information
  /// "lever_arm_y and boresight_pitch together; they may be wrong by -0.013 m and 35 arcsec (one
  /// standard deviation), each up to 13.1 mm on the ground"
  std::string text;
};

/// Parameters that the observations cannot separate, or one that they hardly determine.
struct WeakCombination {
  std::vector<SystemParameter> parameters;  ///< one or two, the less certain one first
  double correlation = 0.0;                 ///< of two
  std::string cause;  ///< from the facts of the block; empty where none applies
  std::string text;  ///< "boresight_pitch with lever_arm_y, correlation 0.97: single flying height"
};

/** \brief Information of a normal matrix about the parameters together (Habib et al. 2011, section
 * 2.2).
 *
 * Units are eliminated by the effect of each parameter on a ground point, see groundEffect().
 */
class Observability {
 public:
  /// \param normal N of all eight, shared errors eliminated, internal units
  /// (Adjustment::reducedNormal())
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
