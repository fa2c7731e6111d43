// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <pcl_als/calibration/pair_weights.h>
#include <pcl_als/calibration/quasi_rigorous_calibration.h>

namespace pcl_als {

/// What changes from iteration to iteration.
struct QuasiRigorousCalibration::State {
  explicit State(const SharedErrors& errors, int threads) : adjustment(errors, threads) {}

  std::size_t observationCount() const {
    std::size_t count = 0;
    for (const AreaObservations& area : observations) count += area.size();
    return count;
  }
  long redundancy() const {
    return static_cast<long>(weights.kept()) - static_cast<long>(choice.estimate.size());
  }
  /// By area, whether any of its pairs has a weight.
  std::vector<bool> usedAreas() const {
    std::vector<bool> used;
    for (const std::vector<double>& area : weights.weights()) {
      used.push_back(std::any_of(area.begin(), area.end(), [](double w) { return w > 0.0; }));
    }
    used.resize(observations.size(), false);
    return used;
  }
  /// Whether all pairs are adjusted, not a chosen part of them.
  bool all() const { return seekers == AreaMatcher::Seekers::candidates; }
  /// Whether the variance components need no further estimation.
  bool looked() const {
    constexpr int kLooks = 8;
    return levels_rest || looks >= kLooks;
  }

  Adjustment adjustment;
  ParameterChoice choice;
  /// Whether choice holds a solution: before, residuals are full of what is sought, and none may be
  /// called an outlier for it.
  bool solved = false;
  /// On the way: nothing is left out for being uncertain, for mismatched pairs make all uncertain.
  bool coarse = true;
  int coarse_iterations = 0;
  double movement = 0.0;  ///< largest movement of a ground point by the last update, metres
  bool settled = false;   ///< whether it was a small part of every standard deviation
  /// Last update of every parameter over its standard deviation; the largest of the last few.
  SystemVector unrest = SystemVector::Zero();
  /// Left out because the iteration does not converge with them, and why.
  std::map<SystemParameter, std::string> excluded;
  bool levels_open =
      false;      ///< whether this iteration estimates the variance components of shared errors
  int looks = 0;  ///< how often they were estimated
  bool levels_rest = false;  ///< whether the last estimation left them unchanged
  AreaMatcher::Seekers seekers = AreaMatcher::Seekers::candidates;
  bool choose_again = false;   ///< of all pairs, in the next iteration
  bool chosen_at_end = false;  ///< chosen after the variance components converged
  double threshold = 0.0;
  std::vector<AreaObservations> observations;
  PairWeights weights;
};

}  // namespace pcl_als
