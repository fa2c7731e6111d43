// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <pcl_als/calibration/adjustment.h>
#include <pcl_als/calibration/pair_observation.h>

namespace pcl_als {

/// How many pairs a calibration keeps.
struct PairSelectionSettings {
  std::size_t budget = 100'000;  ///< pairs of strips; control is always kept
  double spread = 0.25;          ///< share of the budget that goes evenly to where strips meet
};

/// A pair that was chosen to represent others.
struct ChosenPair {
  std::size_t index = 0;    ///< in its area
  double stands_for = 1.0;  ///< how many pairs it weighs as much as
  double offset = 0.0;      ///< metres, added to its misclosure
};

/** \brief A reduced set of pairs that gives nearly the estimates of all pairs.
 *
 * Pairs of the same area, strips, and class of slope and aspect are a group of much the same rows.
 * Of N in it n are kept, each weighing as much as N / n, so that the equations stay what they were.
 * And where two strips meet in an area the chosen pairs get offsets n's(t) + c d: a displacement
 * that changes with the strips' times, and a ranging share. They are such that sum w v n,
 * sum w v n t and sum w v d are those of all pairs there, v their residuals, n their normals, d
 * what a ranging share does: the noise of pairs that were left out still averages out, for rows
 * there are n'A with an A that hardly changes over 50 m but for the time. What the chosen ones
 * follow by themselves is how the geometry changes from then on.
 *
 * n is in proportion to N q, at most N, at least one: q^2 is the group's mean of w^2 v r C W C r',
 * what the noise of one of its pairs moves the parameters by (w its weight, r its row with the
 * shared errors eliminated, C the covariance, W = 1 / diag C). It would be the best allocation were
 * there no offsets. A part of the budget is spent evenly over all areas and pairs of strips first.
 * Members of a group are taken at even steps. Deterministic.
 *
 * Source: optimum allocation (Neyman 1934; Cochran, Sampling Techniques, 1977, 5.5), difference
 * estimator (there, 7.2).
 */
class PairSelection {
 public:
  /// \param weights of Adjustment::accumulate; pairs without weight are never chosen.
  /// \param adjustment that of all these pairs, \a solution what it came to
  PairSelection(const std::vector<AreaObservations>& observations,
                const std::vector<std::vector<double>>& weights, const Adjustment& adjustment,
                const AdjustmentSolution& solution, const PairSelectionSettings& settings);

  /// By area, in the order of the observations.
  const std::vector<std::vector<ChosenPair>>& chosen() const { return chosen_; }
  std::size_t chosenCount() const;

 private:
  struct Group;
  /// Indices of the groups where two strips meet in an area.
  using Meetings = std::map<std::pair<std::size_t, std::array<int, 2>>, std::vector<std::size_t>>;
  static Meetings meetingsOf(const std::vector<Group>& groups);

  /// Also keeps all control.
  std::vector<Group> groupsOf(std::size_t area, const AreaObservations& observations,
                              const std::vector<double>& weights, const Adjustment& adjustment,
                              const AdjustmentSolution& solution);
  void spreadEvenly(std::vector<Group>& groups) const;
  void spendOnInfluence(std::vector<Group>& groups) const;
  void takeMembers(std::vector<Group>& groups);
  /// Makes the pairs kept of the groups of two strips in an area represent all of them.
  void moveToAll(const std::vector<const Group*>& meeting);

  PairSelectionSettings settings_;
  std::vector<std::vector<ChosenPair>> chosen_;
};

}  // namespace pcl_als
