// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>
#include <vector>

#include "block_calibration.h"
#include "block_solution.h"
#include "iteration_control.h"
#include "pair_set.h"
#include "prior_comparison.h"

namespace pcl_als {

/// The estimate of a block after its iteration: what diagnosis and verdict are made from.
struct BlockEstimate {
  PairSet pairs;
  BlockSolution solution;
  /// Solution with all error sources; not solved where they were not looked for.
  AdjustmentSolution diagnosed;
  ErrorSourceScale scale;
  IterationControl control;
  /// The parameters of which the prior was not used because of the observations, in this order.
  std::vector<PriorDifference> released{};

  Corrections corrections() const { return solution.corrections(pairs.rules.held_sources); }
};

using IterationCallback = std::function<void(const CalibrationIteration&)>;

/** \brief Where the iteration begins: pairs of the points as delivered.
 *
 * An offset of the block from control that is larger than any error of a system is removed from
 * the points (startingOffset()).
 */
BlockEstimate startOf(AreaSample& sample);

/** \brief Estimates the parameters of a block: pairs are formed, adjusted (Eqs. (25), (26)) and
 * formed anew with the corrected points, until convergence. Collective.
 *
 * What a prior from other missions says of a parameter that the observations contradict
 * (priorDifferences()) is not used any more, the most significant one first, and the iteration
 * continues: a mean of both would be right for neither mission.
 *
 * \param progress called after every iteration
 */
void iterateToConvergence(AreaSample& sample, ChoiceRules& rules, const IterationCallback& progress,
                          BlockEstimate& estimate);

/// Upper bound of the movement of a ground point by a change of the corrections, and the largest
/// movement of one that was observed.
IterationMovement movementOf(const PairSet& pairs, const Corrections& before,
                             const Corrections& after);

/// Median height of the strips, as delivered, above control points or, without any, above surfaces
/// that are held fixed, where it is larger than any error of a system; zero otherwise. Collective.
double startingOffset(const AreaSample& sample, const PairSet& pairs);

/// A parameter that the block does not determine, or that was not asked for, must not appear as an
/// error with a similar effect: it has a wide prior. With control, where an offset of the block is
/// a hypothesis, the range bias has one as well, and lever_arm_z, which has the effect of such an
/// offset, is left to it.
AdjustmentSolution solveForAllParameters(const Adjustment& adjustment,
                                         const std::vector<SystemParameter>& estimated,
                                         bool to_control);

}  // namespace pcl_als
