// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "rejected_pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pcl_als {
namespace {

constexpr std::size_t kFewestPairs = 50;  // pairs of a strip in a second
constexpr int kReweightings = 4;          // without rejection

struct Count {
  std::size_t all = 0, lost = 0;
};
/// By strip and second.
using Counts = std::map<std::pair<int, long>, Count>;

void add(const PairObservation& o, bool lost, Counts& counts) {
  if (o.a == PairObservation::kControl) return;
  for (const auto& [strip, time] : {std::pair(o.a, o.time_a), std::pair(o.b, o.time_b)}) {
    Count& count = counts[{strip, std::lround(std::floor(time))}];
    ++count.all;
    count.lost += lost ? 1 : 0;
  }
}

}  // namespace

bool areRejectedTogether(const PairSet& pairs, const std::vector<std::vector<double>>& weights) {
  Counts counts;
  for (std::size_t area = 0; area < pairs.observations.size(); ++area) {
    for (std::size_t i = 0; i < pairs.observations[area].size(); ++i)
      add(pairs.observations[area][i], weights[area][i] == 0.0, counts);
  }
  for (const AreaObservations& area : pairs.far)
    for (const PairObservation& o : area) add(o, true, counts);
  return std::any_of(counts.begin(), counts.end(), [](const auto& entry) {
    return entry.second.all >= kFewestPairs && 2 * entry.second.lost > entry.second.all;
  });
}

BlockSolution solutionOfAll(const BlockSolution& solution, const PairSet& pairs, int threads) {
  BlockSolution all = solution;
  for (int i = 0; i <= kReweightings; ++i) {
    weigh(pairs, i == kReweightings, threads, all);
    all.adjustment.accumulate(pairs.observations, all.weights.weights());
    AdjustmentSolution solved =
        all.adjustment.solve(all.choice.estimate, solution.solution().biases);
    if (!solved.solved) return solution;
    all.choice.solution = std::move(solved);
  }
  return all;
}

}  // namespace pcl_als
