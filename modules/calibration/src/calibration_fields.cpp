// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Differences between the points of one strip that differ in a field (SystemCalibrationEngine).
#include <algorithm>

#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/shared_vectors.h>

#include "calibration_state.h"
#include "field_differences.h"
#include "group_differences.h"

namespace pcl_als {
namespace {

Remedy remedyOf(PointField field) {
  if (field == PointField::scanner_channel) return Remedy::channels;
  return field == PointField::user_data ? Remedy::user_data : Remedy::none;
}

/// Points of a strip with one value of a field, in an area.
struct ValueCount {
  int strip = 0, value = 0;
  std::size_t points = 0;
};

/// Lets the misclosures of observations be those of points corrected for all that they were
/// corrected for when they were formed.
void removeCorrections(const std::vector<AreaMatcher::StripCorrection>& corrections,
                       const ErrorSourceVector& sources, AreaObservations& observations) {
  const auto of = [&](int strip) {
    const auto& correction = corrections[static_cast<std::size_t>(strip)];
    SystemUnknowns all;
    all << correction.biases->biases(), correction.offset;
    return all;
  };
  for (PairObservation& o : observations)
    o.misclosure -= o.effectAtPoint(of(o.a)) - o.effectAtPatch(of(o.b)) + o.sources * sources;
}

}  // namespace

FieldDivision SystemCalibrationEngine::divisionBy(PointField field) const {
  std::vector<std::vector<ValueCount>> counts(matchers_.size());
  forOwnAreas([&](std::size_t i) {
    if (i >= pair_areas_) return;
    for (const auto& [strip, values] : matchers_[i].valuesOf(field, *trajectory_))
      for (const auto& [value, points] : values) counts[i].push_back({strip, value, points});
  });
  shareVectors(processes_, area_shares_, counts);
  ValueCounts sums;
  for (const std::vector<ValueCount>& area : counts)
    for (const ValueCount& count : area) sums[count.strip][count.value] += count.points;
  return FieldDivision::of(field, sums);
}

std::vector<AreaObservations> SystemCalibrationEngine::pairsOf(const FieldDivision& division,
                                                               const State& state) const {
  constexpr std::size_t kLeastCandidates = 20;  // of a part, in an area
  const StripCorrections corrections = correctionsOf(state);
  const auto of_parts = division.repeated(corrections.strips);
  std::vector<int> strips;
  for (int strip = 0; strip < static_cast<int>(ids_.size()); ++strip)
    if (used_[static_cast<std::size_t>(strip)] && !isHeld(strip)) strips.push_back(strip);
  std::vector<StripPair> between;
  for (const StripPair& pair : pairs_)
    if (!isHeld(pair.first) && !isHeld(pair.second)) between.push_back(pair);
  const std::vector<StripPair> pairs = division.pairs(between, strips);
  // Every part forms pairs with every part of another strip: about as many in all as whole strips.
  const std::size_t candidates = std::max(
      kLeastCandidates, candidatesOfStrips().per_strip / (division.parts() * division.parts()));
  std::vector<AreaObservations> found(matchers_.size());
  forOwnAreas([&](std::size_t i) {
    if (i >= pair_areas_) return;
    AreaMatcher matcher =
        matchers_[i].divided(division, candidates, settings_.resolution, *trajectory_);
    matcher.correct(of_parts, corrections.sources, *trajectory_);
    found[i] = matcher.match(pairs, settings_.max_normal_distance, *trajectory_, settings_.noise);
    removeCorrections(of_parts, corrections.sources, found[i]);
  });
  shareVectors(processes_, area_shares_, found);
  return found;
}

void SystemCalibrationEngine::diagnoseFields(const State& state, const ScanGeometry& edge,
                                             CalibrationResult& result) const {
  for (const PointField field :
       {PointField::scanner_channel, PointField::user_data, PointField::scan_direction}) {
    // The beam of other scanners does not go back and forth.
    if (field == PointField::scan_direction && (conical_ || rosette_)) continue;
    const FieldDivision division = divisionBy(field);
    if (division.values.empty()) continue;
    AdjustedBlock block{flownTimes(), settings_.shared_errors, state.adjustment.levels(),
                        state.choice.estimate, settings_.threads};
    block.model.biases.mean -= state.choice.solution.biases;  // a prior of their changes
    const std::size_t before = result.diagnosis.size();
    for (ErrorFinding& finding : fieldDifferences(division, block, pairsOf(division, state), edge))
      result.diagnosis.push_back(std::move(finding));
    judgeDifferences(before, settings_.shared_errors.position, remedyOf(field), result);
  }
}

}  // namespace pcl_als
