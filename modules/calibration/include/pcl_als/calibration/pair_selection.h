// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include <pcl_als/calibration/pair_observation.h>

namespace pcl_als {

/// How many pairs a calibration keeps, and what it takes for granted when it chooses them.
struct PairSelectionSettings {
  std::size_t budget = 100'000;   ///< pairs of strips; control is always kept
  double spread = 0.25;           ///< share of the budget that goes evenly to where strips meet
  double shared_variance = 2e-4;  ///< m^2, of what pairs of two strips in one area share
};

/** \brief The pairs that determine the parameters, of all that were found: a D-optimal design.
 *
 * Pairs of the same area, strips and class of slope and aspect are much alike, and share errors
 * that more of them do not average out: n of them with variance v_p each and v_s in common are
 * worth one observation of variance v_s + v_p / n. Numbers n are sought, in all the budget, that
 * maximise the determinant of N = sum r'r / (v_s + v_p / n) with r the mean row of the group: where
 * d ln|N| / dn is the same in every group,
 *   n = (sqrt(v_p r N^-1 r' / lambda) - v_p) / v_s, between 0 and what there is;
 * N and lambda are found in turn. A part of the budget is spent evenly over all areas and pairs of
 * strips first, so that no part of the block goes unseen. Members of a group are taken at even
 * steps. Deterministic.
 */
class PairSelection {
 public:
  /// \param weights robust weight / noise scale^2, by area and observation; pairs without weight
  /// are never chosen.
  PairSelection(const std::vector<AreaObservations>& observations,
                const std::vector<std::vector<double>>& weights,
                const PairSelectionSettings& settings);

  /// Indices of the chosen observations, ascending, by area.
  const std::vector<std::vector<std::size_t>>& chosen() const { return chosen_; }
  std::size_t chosenCount() const;

 private:
  struct Group;

  std::vector<Group> groupsOf(const std::vector<AreaObservations>& observations,
                              const std::vector<std::vector<double>>& weights);
  void spreadEvenly(std::vector<Group>& groups) const;
  void spendOnInformation(std::vector<Group>& groups) const;
  void takeMembers(const std::vector<Group>& groups);

  PairSelectionSettings settings_;
  std::vector<std::vector<std::size_t>> chosen_;
};

}  // namespace pcl_als
