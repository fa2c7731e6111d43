// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Differences between the points of one strip that differ in a field.
#include <algorithm>

#include "area_matcher.h"
#include "block_diagnosis.h"
#include "field_differences.h"
#include "group_differences.h"
#include "strip_corrections.h"

namespace pcl_als {
namespace {

Hint remedyOf(PointField field) {
  if (field == PointField::scanner_channel) return Hint::channels;
  return field == PointField::user_data ? Hint::user_data : Hint::none;
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
    o.misclosure -=
        o.effectAtPoint(of(o.a)) - o.effectAtPatch(of(o.b)) + o.effectOfSources(sources);
}

/// The part of each area that determines differences well enough.
struct AreaPart {
  double share;       ///< of the area
  double candidates;  ///< of a strip in it
};

AreaPart partFor(const AreaSample::Candidates& all) {
  constexpr double kPairsForDifferences = 50e3;  // more determine no difference that matters
  const double share = std::min(1.0, kPairsForDifferences / static_cast<double>(all.pairs));
  return {share, share * static_cast<double>(all.per_strip)};
}

FieldDivision divisionBy(PointField field, double share, const AreaSample& sample) {
  const SurveyBlock& block = sample.block();
  const auto counts = sample.collect<ValueCount>([&](std::size_t i,
                                                     std::vector<ValueCount>& found) {
    if (block.isControl(i)) return;
    for (const auto& [strip, values] : sample.area(i).valuesOf(field, share, block.trajectory()))
      for (const auto& [value, points] : values) found.push_back({strip, value, points});
  });
  ValueCounts sums;
  for (const std::vector<ValueCount>& area : counts)
    for (const ValueCount& count : area) sums[count.strip][count.value] += count.points;
  return FieldDivision::of(field, sums);
}

/// All pairs of the parts of divided strips.
std::vector<StripPair> pairsOfParts(const FieldDivision& division, const SurveyBlock& block) {
  const std::vector<bool> corrected = block.strips.corrected();
  std::vector<int> strips;
  for (std::size_t i = 0; i < corrected.size(); ++i)
    if (corrected[i]) strips.push_back(static_cast<int>(i));
  std::vector<StripPair> between;
  for (const StripPair& pair : block.pairs)
    if (!block.strips.isFixed(pair.first) && !block.strips.isFixed(pair.second))
      between.push_back(pair);
  return division.pairs(between, strips);
}

/// The observations of the parts of divided strips, by area; misclosures are those of corrected
/// points.
std::vector<AreaObservations> observationsOf(const FieldDivision& division, const AreaPart& part,
                                             const AreaSample& sample,
                                             const Corrections& corrections) {
  constexpr std::size_t kLeastCandidates = 20;  // of a part, in an area
  const SurveyBlock& block = sample.block();
  const CalibrationSettings& settings = block.settings();
  const StripCorrections of_strips(block, corrections);
  const auto of_parts = division.repeated(of_strips.strips());
  const std::vector<StripPair> pairs = pairsOfParts(division, block);
  // Every part forms pairs with every part of another strip: about as many in all as whole strips.
  const std::size_t candidates =
      std::max(kLeastCandidates,
               static_cast<std::size_t>(part.candidates) / (division.parts() * division.parts()));
  return sample.collect<PairObservation>([&](std::size_t i, AreaObservations& found) {
    if (block.isControl(i)) return;
    AreaMatcher matcher = sample.area(i).divided(division, part.share, candidates,
                                                 settings.resolution, block.trajectory());
    matcher.correct(of_parts, corrections.sources, block.trajectory());
    found = matcher.match(pairs, settings.max_normal_distance, block.trajectory(), settings.noise);
    removeCorrections(of_parts, corrections.sources, found);
  });
}

}  // namespace

void diagnoseFields(const AreaSample& sample, const BlockEstimate& estimate,
                    const ScanGeometry& edge, CalibrationResult& result) {
  const SurveyBlock& block = sample.block();
  const CalibrationSettings& settings = block.settings();
  const BlockSolution& solution = estimate.solution;
  const AreaPart part = partFor(sample.candidates());
  for (const PointField field :
       {PointField::scanner_channel, PointField::user_data, PointField::scan_direction}) {
    // The beam of other scanners does not go back and forth.
    if (field == PointField::scan_direction && !block.scanner.isLinear()) continue;
    const FieldDivision division = divisionBy(field, part.share, sample);
    if (division.values.empty()) continue;
    AdjustedBlock adjusted{block.flownTimes(), errorModelOf(block, solution),
                           solution.adjustment.levels(), solution.choice.estimate,
                           settings.threads};
    adjusted.model.biases.mean -= solution.solution().biases;  // a prior of their changes
    const std::size_t before = result.diagnosis.size();
    for (ErrorFinding& finding :
         fieldDifferences(division, adjusted,
                          observationsOf(division, part, sample, estimate.corrections()), edge))
      result.diagnosis.push_back(std::move(finding));
    judgeDifferences(before, settings.shared_errors.position, remedyOf(field), result);
  }
}

}  // namespace pcl_als
