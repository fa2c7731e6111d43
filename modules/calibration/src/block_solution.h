// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "adjustment.h"
#include "pair_set.h"
#include "pair_weights.h"
#include "parameter_choice.h"

namespace pcl_als {

/// The modified least squares solution of the pairs of a block, Eqs. (25), (26).
struct BlockSolution {
  Adjustment adjustment;  ///< of the pairs, with the variance components of the shared errors
  PairWeights weights;
  bool weighed = false;  ///< whether the weights are those of the pairs and this solution
  ParameterChoice choice;
  std::vector<SystemUnknowns> differences;  ///< of the systems to the first one

  /// Without estimates: all parameters are zero.
  BlockSolution(const SharedErrors& errors, int threads);

  const AdjustmentSolution& solution() const { return choice.solution; }
  /// Corrections of the points for the parameters, the systems and the error sources, those that
  /// are estimated (ranging on slopes, which depends on surfaces, excepted) and those held.
  Corrections corrections(const ErrorSourceVector& held_sources) const;
  long redundancy() const {
    return static_cast<long>(weights.kept()) - static_cast<long>(choice.estimate.size());
  }
};

/// Which parameters are estimated.
struct ChoiceRules {
  const CalibrationSettings& settings;
  bool control_covered = false;  ///< whether any strip has a patch at a control point
  /// In the coarse phase no parameter is excluded, because mismatched pairs make all uncertain.
  bool coarse = true;
  /// Parameters excluded because the iteration does not converge with them, with the reason.
  std::map<SystemParameter, std::string> excluded;
};

/// Residuals of the pairs after a solution, by area.
PairWeights::Residuals pairResiduals(const std::vector<AreaObservations>& observations,
                                     const Adjustment& adjustment,
                                     const AdjustmentSolution& solution, int threads);

/// Robust weights from the residuals. \a reject: whether outliers lose their weight; not while
/// residuals contain the effect of the biases.
void weigh(const PairSet& pairs, bool reject, int threads, BlockSolution& solution);

/// Solves for the parameters that the accumulated pairs determine, and for the unknowns of systems
/// after the first that they determine.
void choose(const ChoiceRules& rules, BlockSolution& solution);

/// Accumulates the pairs with their weights, and solves. \a first: there is no solution yet, and
/// the weights are found with it by iteration.
void adjust(const PairSet& pairs, const ChoiceRules& rules, bool first, BlockSolution& solution);

/// Six robust standard deviations of the distances of the pairs of strips that scatter most, but at
/// least 0.25 m and no more than \a threshold, metres.
double smallerThreshold(const PairSet& pairs, const BlockSolution& solution, double threshold);

}  // namespace pcl_als
