// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "adjustment.h"
#include "pair_observation.h"

namespace pcl_als {

/// Size of a selection of pairs.
struct PairSelectionSettings {
  std::size_t budget = 100'000;  ///< pairs of strips; control is always kept
  /// share of the budget that is distributed evenly over areas and pairs of strips
  double spread = 0.25;
};

/// A pair that was chosen to represent others.
struct ChosenPair {
  std::size_t index = 0;     ///< in its area
  double represented = 1.0;  ///< number of pairs that it represents
  double offset = 0.0;       ///< metres, added to its misclosure
};

/** \brief A reduced set of pairs that gives nearly the estimates of all pairs.
 *
 * Pairs of the same area, strips, and class of slope and aspect form a group with nearly equal
 * rows. Of N pairs in a group n are kept, each with the weight of N / n, so that the normal
 * equations are preserved. For two strips in an area the chosen pairs have offsets n's(t) + c d: a
 * displacement that changes with the times of the strips, and a ranging share. The offsets make sum
 * w v n, sum w v n t and sum w v d equal to those of all pairs there, with residuals v, normals n
 * and d the effect of a ranging share: the noise of the other pairs is averaged as well, because
 * rows there are n'A with an A that hardly changes over 50 m except with time. Changes of the
 * geometry after the selection are represented by the chosen pairs alone.
 *
 * n is in proportion to N q, at most N, at least one: q^2 is the group's mean of w^2 v r C W C r',
 * the effect of the noise of one of its pairs on the parameters (w its weight, r its row with the
 * shared errors eliminated, C the covariance, W = 1 / diag C). This would be the optimum allocation
 * without offsets. A part of the budget is distributed evenly over all areas and pairs of strips
 * first. Members of a group are taken at even steps. The selection is deterministic.
 *
 * Source: optimum allocation (Neyman 1934; Cochran, Sampling Techniques, 1977, 5.5), difference
 * estimator (Cochran, 7.2).
 */
class PairSelection {
 public:
  /// \param weights of Adjustment::accumulate; pairs without weight are never chosen.
  /// \param adjustment that of all these pairs, \a solution its solution
  PairSelection(const std::vector<AreaObservations>& observations,
                const std::vector<std::vector<double>>& weights, const Adjustment& adjustment,
                const AdjustmentSolution& solution, const PairSelectionSettings& settings);

  /// The chosen pairs by area, in the order of the observations.
  const std::vector<std::vector<ChosenPair>>& chosen() const { return chosen_; }
  std::size_t chosenCount() const;

 private:
  struct Group;
  /// Indices of the groups of two strips in an area.
  using StripsInAreas =
      std::map<std::pair<std::size_t, std::array<int, 2>>, std::vector<std::size_t>>;
  static StripsInAreas stripsInAreas(const std::vector<Group>& groups);

  /// Also keeps all control.
  std::vector<Group> groupsOf(std::size_t area, const AreaObservations& observations,
                              const std::vector<double>& weights, const Adjustment& adjustment,
                              const AdjustmentSolution& solution);
  void spreadEvenly(std::vector<Group>& groups) const;
  void spendOnInfluence(std::vector<Group>& groups) const;
  void takeMembers(std::vector<Group>& groups);
  /// Sets the offsets of the chosen pairs of two strips in an area.
  void setOffsets(const std::vector<const Group*>& groups_of_strips);

  PairSelectionSettings settings_;
  std::vector<std::vector<ChosenPair>> chosen_;
};

}  // namespace pcl_als
