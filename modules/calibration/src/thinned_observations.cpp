// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include "pair_observation.h"

namespace pcl_als {

WeightedObservations thinned(const std::vector<AreaObservations>& observations,
                             const std::vector<std::vector<double>>& weights, std::size_t count) {
  constexpr std::size_t kLeast = 20;  // observations of an area
  constexpr double kGolden = 0.6180339887498949;
  std::size_t all = 0;
  for (const AreaObservations& area : observations) all += area.size();
  const std::size_t wanted = std::max<std::size_t>(1, (all + count - 1) / count);
  WeightedObservations few;
  few.observations.resize(observations.size());
  few.weights.resize(observations.size());
  for (std::size_t area = 0; area < observations.size(); ++area) {
    const AreaObservations& from = observations[area];
    // All control is kept, because there is little of it.
    const bool control = !from.empty() && from.front().a == PairObservation::kControl;
    const std::size_t step =
        control ? 1 : std::min(wanted, std::max<std::size_t>(1, from.size() / kLeast));
    double turn = 0.0;
    for (std::size_t first = 0; first < from.size(); first += step) {
      // One observation of every step at varying positions, because neighbours are arranged in
      // patterns.
      turn = std::fmod(turn + kGolden, 1.0);
      const std::size_t length = std::min(step, from.size() - first);
      const std::size_t i = first + static_cast<std::size_t>(turn * static_cast<double>(length));
      few.observations[area].push_back(from[i]);
      few.observations[area].back().misclosure = 0.0;
      few.weights[area].push_back(weights[area][i] * static_cast<double>(length));
    }
  }
  return few;
}

}  // namespace pcl_als
