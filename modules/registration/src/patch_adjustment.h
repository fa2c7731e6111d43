// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/adjustment/robust_weight.h>

#include "patch_pair.h"

namespace pcl_als::registration {

/// Unknowns in metres: shift, rotation times the radius, scale times the radius.
constexpr int kUnknowns = 7;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using UnknownsMatrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/** \brief Where the unknowns are about and what they are multiplied by, so that all are metres on
 * the ground: a rotation of y / radius moves points at the radius by y. */
struct AdjustmentFrame {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< in the target's frame
  double radius = 1.0;                               ///< metres
  bool with_scale = false;

  int unknowns() const { return with_scale ? kUnknowns : kUnknowns - 1; }
  /// d distance / d unknowns of a pair.
  Unknowns rowOf(const PatchPair& pair) const;
  /// Expected part of row row' that the noise of the normal makes.
  UnknownsMatrix noiseOf(const PatchPair& pair) const;
  /// The motion that unknowns stand for: follows the one the pairs were found with.
  Eigen::Affine3d motionOf(const Unknowns& unknowns) const;
};

/// Least squares sums: normal matrix, right hand side, weights.
struct NormalEquations {
  UnknownsMatrix matrix = UnknownsMatrix::Zero();
  UnknownsMatrix noise = UnknownsMatrix::Zero();  ///< of that, what the normals' noise alone makes
  Unknowns right = Unknowns::Zero();
  double weights = 0.0;

  void merge(const NormalEquations& other);
};

/// What fixes the unknowns, and in which directions nothing does.
struct Directions {
  UnknownsMatrix vectors = UnknownsMatrix::Identity();  ///< columns, ascending information
  Unknowns values = Unknowns::Zero();                   ///< eigenvalues, 1 / m^2
  double weights = 0.0;
  int unknowns = kUnknowns - 1;
  int weak = 0;  ///< the first columns, which are not determined
};

/** \brief Scatter of the pairs' distances over the roots of their variances, metres, by slope.
 *
 * On slopes points scatter more, by their errors in plan and the width of the beam; flat ground is
 * most of what there is and would decide for all that everything on slopes is an outlier.
 */
struct ScatterBySlope {
  static constexpr int kSteps = 4;
  std::array<double, kSteps> sigma{};
  std::array<std::size_t, kSteps> pairs{};

  static int stepOf(const PatchPair& pair);
  double of(const PatchPair& pair) const { return sigma[stepOf(pair)]; }
  double largest() const { return *std::max_element(sigma.begin(), sigma.end()); }
  double all() const;  ///< of unit weight: the root of the mean square over all pairs, metres
};

/// How pairs that fit badly are weighed, in standard deviations: by Huber's weights from the first
/// on, not at all beyond the second.
struct Robustness {
  double huber = kHuberLimit, cut = kRejectionLimit;

  /// Movement is still to come: outliers cannot be recognised yet.
  static Robustness whileMoving() { return {1.5, std::numeric_limits<double>::infinity()}; }
  /// Hardly robust, for a second opinion.
  static Robustness trusting() { return {10.0, 20.0}; }
};

/** \brief Robust least squares over pairs; a pair that fits weighs 1 / (variance scatter^2). All
 * sums are over fixed chunks: the same whatever the number of threads.
 */
class PatchAdjustment {
 public:
  PatchAdjustment(const PatchPairs& pairs, const AdjustmentFrame& frame,
                  const Robustness& robustness, int threads)
      : pairs_(pairs), frame_(frame), robustness_(robustness), threads_(threads) {}

  ScatterBySlope scatter(const Unknowns& unknowns) const;
  NormalEquations accumulate(const Unknowns& unknowns, const ScatterBySlope& scatter) const;
  /// By group, in order of their numbers; groups without weight are left out.
  std::vector<NormalEquations> accumulateGroups(const ScatterBySlope& scatter,
                                                std::size_t groups) const;
  /// Covariance of the solution where errors vary slowly over the ground (CorrelatedErrors), metres
  /// squared; zero with too few cells.
  UnknownsMatrix correlated(const ScatterBySlope& scatter, const Directions& directions) const;

 private:
  double weightOf(double rest, const PatchPair& pair, const ScatterBySlope& scatter) const;

  const PatchPairs& pairs_;
  const AdjustmentFrame& frame_;
  Robustness robustness_;
  int threads_;
};

/// Eigen-analysis of the information of the normals beyond their noise: directions whose standard
/// deviation exceeds \a limit (metres) are weak.
Directions analyse(const NormalEquations& equations, int unknowns, double limit);

/// The least squares solution in the determined directions; \a prior_information is added to each.
Unknowns solveDetermined(const NormalEquations& equations, const Directions& directions,
                         double prior_information = 0.0);
/// N^-1 in the determined directions, zero in the others.
UnknownsMatrix cofactor(const NormalEquations& equations, const Directions& directions);
/// Covariance of the solution from leaving out one group at a time, metres squared; zero with too
/// few groups.
UnknownsMatrix jackknife(const std::vector<NormalEquations>& groups, const Directions& directions);

/// Why a parameter that a weak direction contains is not determined.
std::string describeWeakness(const Directions& directions, int parameter, double radius);

}  // namespace pcl_als::registration
