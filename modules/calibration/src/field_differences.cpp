// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "field_differences.h"

#include <algorithm>
#include <set>

#include "group_differences.h"

namespace pcl_als {
FieldDivision FieldDivision::of(PointField field, const ValueCounts& counts) {
  constexpr std::size_t kMaximumParts = 16;  // parts of one instrument
  // An oscillating mirror measures half of its points in each direction.
  const double least_share = field == PointField::scan_direction ? 0.3 : 0.02;
  std::map<int, double> sums;
  double total = 0.0;
  for (const auto& [strip, of_strip] : counts)
    for (const auto& [value, count] : of_strip) {
      sums[value] += static_cast<double>(count);
      total += static_cast<double>(count);
    }
  FieldDivision division;
  division.field = field;
  for (const auto& [value, sum] : sums)
    if (sum >= least_share * total) division.values.push_back(value);
  const auto several = [&](const auto& of_strip) {
    return std::count_if(division.values.begin(), division.values.end(),
                         [&](int value) { return of_strip.second.count(value) > 0; }) > 1;
  };
  if (division.values.size() > kMaximumParts || std::none_of(counts.begin(), counts.end(), several))
    division.values.clear();
  return division;
}

std::string FieldDivision::nameOf(std::size_t k) const {
  const int value = values[k];
  if (field == PointField::scan_direction)
    return value < 0 ? "points_scanned_to_the_right" : "points_scanned_to_the_left";
  return (field == PointField::user_data ? "user_data" : "channel") + std::to_string(value);
}

std::vector<StripPair> FieldDivision::pairs(const std::vector<StripPair>& of_strips,
                                            const std::vector<int>& strips) const {
  std::vector<StripPair> pairs;
  for (const int strip : strips)
    for (std::size_t k = 0; k < parts(); ++k)
      for (std::size_t l = k + 1; l < parts(); ++l)
        pairs.emplace_back(partOf(strip, k), partOf(strip, l));
  for (const auto& [a, b] : of_strips)
    for (std::size_t k = 0; k < parts(); ++k)
      for (std::size_t l = 0; l < parts(); ++l) pairs.emplace_back(partOf(a, k), partOf(b, l));
  return pairs;
}

StripSystems FieldDivision::systems(std::size_t strips) const {
  StripSystems systems;
  systems.count = static_cast<int>(parts());
  systems.own = {{}, false};
  for (int strip = 0; strip < static_cast<int>(strips); ++strip)
    for (std::size_t k = 0; k < parts(); ++k) {
      systems.system.push_back(static_cast<int>(k));
      systems.pass.push_back(partOf(strip, 0));
    }
  return systems;
}

std::vector<ErrorFinding> fieldDifferences(const FieldDivision& division,
                                           const AdjustedBlock& block,
                                           const std::vector<AreaObservations>& observations,
                                           const ScanGeometry& edge) {
  const std::vector<TimeSpan> spans = division.repeated(block.spans);
  const std::vector<std::vector<TimeSpan>> observed = observedTimes(observations, spans.size());
  SharedErrors errors(spans, withKnotsFor(block.model, observed), observed,
                      division.systems(block.spans.size()));
  Adjustment adjustment(errors, block.threads);
  adjustment.setVarianceFactors(block.levels);
  ParameterChoice choice;
  choice.estimate = block.estimate;
  choice.solution = adjustment.unsolved(SystemVector::Zero());
  std::vector<StripGroup> groups;
  for (std::size_t k = 0; k < division.parts(); ++k) groups.push_back({division.nameOf(k), {}});
  std::vector<ErrorFinding> findings;
  if (!weighWithDifferences(groups, choice, observations, block.threads, adjustment))
    return findings;
  std::set<int> strips;
  for (const AreaObservations& area : observations)
    for (const PairObservation& o : area) strips.insert(o.b / errors.systems().count);
  addGroupDifferences(groups, strips.size(), edge, choice, adjustment, findings);
  return findings;
}

}  // namespace pcl_als
