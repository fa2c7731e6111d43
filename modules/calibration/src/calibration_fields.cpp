// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Differences between the points of one strip that differ in a field (SystemCalibrationEngine).
#include <algorithm>
#include <map>
#include <utility>

#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/shared_vectors.h>

#include "calibration_state.h"
#include "field_differences.h"
#include "group_differences.h"

namespace pcl_als {
namespace {

/// Points of a strip with one value of a field.
struct ValueCount {
  int strip = 0, value = 0;
  double points = 0.0;
};
using StripInArea = std::pair<std::size_t, int>;  ///< area, strip

/// Strips in areas where points of the reference value and of others form surfaces, evenly chosen.
std::vector<StripInArea> comparedParts(const ComparedValues& values,
                                       const std::vector<std::vector<ValueCount>>& counts) {
  constexpr double kEnough = 200.0;   // points that form a surface
  constexpr std::size_t kParts = 32;  // clusters of the covariance
  std::vector<StripInArea> parts;
  for (std::size_t area = 0; area < counts.size(); ++area) {
    std::map<int, std::pair<bool, bool>> present;  // by strip: the reference, another value
    for (const ValueCount& count : counts[area]) {
      if (count.points < kEnough) continue;
      const bool other =
          std::binary_search(values.others.begin(), values.others.end(), count.value);
      if (count.value == values.reference) present[count.strip].first = true;
      if (other) present[count.strip].second = true;
    }
    for (const auto& [strip, both] : present)
      if (both.first && both.second) parts.emplace_back(area, strip);
  }
  std::vector<StripInArea> chosen;
  for (std::size_t i = 0; i < std::min(kParts, parts.size()); ++i)
    chosen.push_back(parts[i * parts.size() / std::min(kParts, parts.size())]);
  return chosen;
}

Remedy divisionBy(PointField field) {
  if (field == PointField::scanner_channel) return Remedy::channels;
  return field == PointField::user_data ? Remedy::user_data : Remedy::none;
}

/// Directions that are not recorded are found where points are divided; about half of the points of
/// an oscillating mirror have each.
std::vector<ValueCount> countsOf(const AreaMatcher& matcher, PointField field, int strips) {
  std::vector<ValueCount> counts;
  for (int strip = 0; strip < strips; ++strip)
    for (const auto& [value, points] : matcher.valuesOf(strip, field)) {
      const auto count = static_cast<double>(points);
      if (field == PointField::scan_direction && value == 0)
        counts.insert(counts.end(), {{strip, -1, 0.5 * count}, {strip, 1, 0.5 * count}});
      else
        counts.push_back({strip, value, count});
    }
  return counts;
}

std::map<int, std::size_t> sumOf(const std::vector<std::vector<ValueCount>>& counts) {
  std::map<int, std::size_t> sum;
  for (const std::vector<ValueCount>& area : counts)
    for (const ValueCount& count : area) sum[count.value] += static_cast<std::size_t>(count.points);
  return sum;
}

/// Pairs between the points of the reference value and the others.
std::vector<StripPair> pairsOf(const ComparedValues& values) {
  std::vector<StripPair> pairs;
  for (int other = 1; other <= static_cast<int>(values.others.size()); ++other)
    pairs.emplace_back(0, other);
  return pairs;
}

}  // namespace

std::vector<std::vector<FieldPair>> SystemCalibrationEngine::pairsByField(
    const StripCorrections& corrections, const ComparedValues& values,
    const std::vector<std::pair<std::size_t, int>>& parts) const {
  constexpr std::size_t kCandidates = 200;  // of one value, in an area
  std::vector<std::vector<FieldPair>> pairs(matchers_.size());
  forOwnAreas([&](std::size_t i) {
    for (const auto& [area, strip] : parts) {
      if (area != i) continue;
      AreaMatcher matcher = matchers_[i].divided(strip, values.field, values.all(), kCandidates,
                                                 settings_.resolution, *trajectory_);
      const auto& correction = corrections.strips[static_cast<std::size_t>(strip)];
      matcher.correct(std::vector(values.all().size(), correction), corrections.sources,
                      *trajectory_);
      const AreaObservations found = matcher.match(pairsOf(values), settings_.max_normal_distance,
                                                   *trajectory_, settings_.noise);
      addFieldPairs(values, strip, found, correction.biases->biases(), corrections.sources,
                    pairs[i]);
    }
  });
  shareVectors(processes_, area_shares_, pairs);
  return pairs;
}

void SystemCalibrationEngine::diagnoseFields(const State& state, const ScanGeometry& edge,
                                             CalibrationResult& result) const {
  const StripCorrections corrections = correctionsOf(state);
  for (const PointField field :
       {PointField::scanner_channel, PointField::user_data, PointField::scan_direction}) {
    // The beam of other scanners does not go back and forth.
    if (field == PointField::scan_direction && (conical_ || rosette_)) continue;
    std::vector<std::vector<ValueCount>> counts(matchers_.size());
    forOwnAreas([&](std::size_t i) {
      if (i < pair_areas_) counts[i] = countsOf(matchers_[i], field, static_cast<int>(ids_.size()));
    });
    shareVectors(processes_, area_shares_, counts);
    const ComparedValues values = comparedValues(field, sumOf(counts));
    if (values.others.empty()) continue;
    const auto pairs = pairsByField(corrections, values, comparedParts(values, counts));
    const std::size_t before = result.diagnosis.size();
    for (ErrorFinding& finding : fieldDifferences(values, pairs, edge))
      result.diagnosis.push_back(std::move(finding));
    judgeDifferences(before, settings_.shared_errors.position, divisionBy(field), result);
  }
}

}  // namespace pcl_als
