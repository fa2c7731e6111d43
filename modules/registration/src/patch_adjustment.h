// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/adjustment/robust_weight.h>

#include "patch_pair.h"
#include "plan_cells.h"

namespace pcl_als::registration {

constexpr std::size_t kFewestGroups = 10;  ///< of a jackknife
constexpr double kNoPrior = 1e9;           ///< metres, standard deviation of an unknown a priori

/// Unknowns in metres: shift, rotation times the radius, scale times the radius.
constexpr int kUnknowns = 7;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using UnknownsMatrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/** \brief Origin and scale of the unknowns, by which all are metres on the ground: a rotation of y
 * / radius moves points at the radius by y. */
struct AdjustmentFrame {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< in the target's frame
  double radius = 1.0;                               ///< metres
  bool with_scale = false;

  int unknowns() const { return with_scale ? kUnknowns : kUnknowns - 1; }
  /// d distance / d unknowns of a pair.
  Unknowns rowOf(const PatchPair& pair) const;
  /// Expected value of row row' due to the noise of the normal.
  UnknownsMatrix noiseOf(const PatchPair& pair) const;
  /// The motion of a vector of unknowns, after the motion with which the pairs were formed.
  Eigen::Affine3d motionOf(const Unknowns& unknowns) const;
};

/// Least squares sums: normal matrix, right hand side, weights.
struct NormalEquations {
  UnknownsMatrix matrix = UnknownsMatrix::Zero();
  /// its expected value due to the noise of the normals alone
  UnknownsMatrix noise = UnknownsMatrix::Zero();
  Unknowns right = Unknowns::Zero();
  double weights = 0.0;

  void add(const Unknowns& row, double rest, double weight);
  void merge(const NormalEquations& other);
};

/// Directions that keep their initial value because their reported standard deviations, which
/// include the errors that neighbouring points share, are too large.
struct HeldDirections {
  std::vector<Unknowns> vectors;  ///< orthonormal
  std::vector<double> std;        ///< metres
};

/// Orthonormal directions by information, and those that are not determined.
struct Directions {
  /// Columns: those that are held, then eigenvectors of the information, ascending.
  UnknownsMatrix vectors = UnknownsMatrix::Identity();
  Unknowns values = Unknowns::Zero();  ///< information along them, 1 / m^2
  /// Metres, of the first columns: as held, or according to the information.
  Unknowns std = Unknowns::Zero();
  double weights = 0.0;
  int unknowns = kUnknowns - 1;
  int held = 0;
  int weak = 0;  ///< number of first columns that are not determined, with those that are held

  int strong() const { return unknowns - weak; }
  /// The directions that are determined.
  Eigen::MatrixXd basis() const { return vectors.middleCols(weak, strong()); }
};

/** \brief Scatter of the pairs' distances over the roots of their variances, metres, by slope.
 *
 * On slopes the scatter is larger because of the errors in plan and the width of the beam. With one
 * scatter for all pairs, most of which are on flat ground, slopes would count as outliers.
 */
struct ScatterBySlope {
  static constexpr int kSteps = 4;
  std::array<double, kSteps> sigma{};
  std::array<std::size_t, kSteps> pairs{};

  static int stepOf(const PatchPair& pair);
  double of(const PatchPair& pair) const { return sigma[stepOf(pair)]; }
  double largest() const { return *std::max_element(sigma.begin(), sigma.end()); }
  double sigmaOf(const PatchPair& pair) const { return of(pair) * std::sqrt(pair.variance); }
  double all() const;  ///< of unit weight: the root of the mean square over all pairs, metres
};

/// What the weights and the determined directions of a solution follow from.
struct Weighting {
  ScatterBySlope scatter;
  Directions directions;
  HeldDirections held;
  bool frozen = false;  ///< scatter and directions stay
};

/// Weights during convergence, when outliers cannot be recognised yet.
constexpr RobustWeight kWhileMoving{kHuberLimit, kNoRejection};
/// Almost without down-weighting, for the second estimate.
constexpr RobustWeight kTrusting{10.0, 20.0};

/** \brief Robust least squares over pairs with weights of 1 / (variance scatter^2). All sums are
 * over fixed chunks and do not depend on the number of threads.
 */
class PatchAdjustment {
 public:
  PatchAdjustment(const PatchPairs& pairs, const AdjustmentFrame& frame, const RobustWeight& robust,
                  int threads);

  /// A few solutions with the weights of the one before, in directions with a standard deviation of
  /// at most \a limit and with the a priori one \a prior (metres); updates \a weighting.
  Unknowns solve(double limit, double prior, Weighting& weighting) const;
  ScatterBySlope scatter(const Unknowns& unknowns) const;
  NormalEquations accumulate(const Unknowns& unknowns, const ScatterBySlope& scatter) const;
  /// By group, in order of their numbers.
  std::vector<NormalEquations> accumulateGroups(const ScatterBySlope& scatter,
                                                std::size_t groups) const;
  /// Covariance of the solution where errors vary slowly over the ground (CorrelatedErrors), metres
  /// squared; zero with too few cells.
  UnknownsMatrix correlated(const ScatterBySlope& scatter, const Directions& directions) const;

 private:
  /// What every solution needs of a pair.
  struct Equation {
    Unknowns row;     ///< d distance / d unknowns
    double distance;  ///< metres
    double root;      ///< of the variance
    int step;         ///< of the slope
  };
  double weightOf(double rest, const Equation& equation, const ScatterBySlope& scatter) const;

  const PatchPairs& pairs_;
  std::vector<Equation> equations_;
  const AdjustmentFrame& frame_;
  RobustWeight robust_;
  int threads_;
};

/// Eigen-analysis of the information of the normals beyond their noise: directions whose standard
/// deviation exceeds \a limit (metres) are weak, as are those that are held.
Directions analyse(const NormalEquations& equations, int unknowns, double limit,
                   const HeldDirections& held = {});

/// The least squares solution in the determined directions; \a prior_information is added to each.
Unknowns solveDetermined(const NormalEquations& equations, const Directions& directions,
                         double prior_information = 0.0);
/// N^-1 in the determined directions, zero in the others.
UnknownsMatrix cofactor(const NormalEquations& equations, const Directions& directions);
/// Covariance of the solution from excluding one group at a time, metres squared; zero with fewer
/// than \a fewest groups that have a weight.
UnknownsMatrix jackknife(const std::vector<NormalEquations>& groups, const Directions& directions,
                         std::size_t fewest = kFewestGroups);
/** \brief The same with variances that are larger where squares of four cells, or strips of cells
 * in either direction, are excluded: where they exceed those of cells by more than chance (95 %).
 *
 * Errors that are shared over more than a cell, as those of a strip that bends along its time, are
 * not seen when single cells are excluded.
 */
UnknownsMatrix jackknifeOfParts(const std::vector<NormalEquations>& cells, const PlanGrid& grid,
                                const Directions& directions);

/// Reason for which a parameter with a component in a weak direction is not determined.
std::string describeWeakness(const Directions& directions, int parameter, double radius);

}  // namespace pcl_als::registration
