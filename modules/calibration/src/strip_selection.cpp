// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "strip_selection.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

void exclude(int strip, ExclusionReason reason, const SurveyMap& map, StripSelection& selection) {
  const auto index = static_cast<std::size_t>(strip);
  selection.strips.used[index] = false;
  selection.excluded.push_back(
      {selection.strips.ids[index], reason, map.pointCount(strip), map.pointCount(strip)});
}

/// With pairs given by name, other strips are used for control only.
void excludeUnpaired(const BlockRequest& request, BlockStrips& strips) {
  if (request.pairs.empty() || !request.control.empty() || !strips.held.empty()) return;
  std::vector<bool> paired(strips.size(), false);
  for (const auto& [a, b] : request.pairs) {
    paired[static_cast<std::size_t>(strips.named(a))] = true;
    paired[static_cast<std::size_t>(strips.named(b))] = true;
  }
  for (std::size_t strip = 0; strip < strips.size(); ++strip)
    if (!paired[strip]) strips.used[strip] = false;
}

void excludeSmall(const SurveyMap& map, std::size_t fewest, StripSelection& selection) {
  const BlockStrips& strips = selection.strips;
  for (int strip = 0; strip < static_cast<int>(strips.size()); ++strip) {
    const std::string& id = strips.ids[static_cast<std::size_t>(strip)];
    const std::size_t count = map.pointCount(strip);
    if (map.invalidCount(strip) > 0)
      selection.warnings.push_back(
          "strip " + id + ": " + std::to_string(map.invalidCount(strip)) +
          " points with a time or coordinate that is not finite were ignored");
    if (count >= fewest || !strips.isFlown(strip)) continue;
    exclude(strip, ExclusionReason::too_few_points, map, selection);
    selection.warnings.push_back("strip " + id + " has only " + std::to_string(count) +
                                 " points and is excluded");
  }
}

/// Strips that hold the points of an earlier one: they would count twice.
void excludeCopies(const SurveyMap& map, StripSelection& selection) {
  const BlockStrips& strips = selection.strips;
  const auto id = [&](int strip) { return strips.ids[static_cast<std::size_t>(strip)]; };
  for (int strip = 1; strip < static_cast<int>(strips.size()); ++strip) {
    for (int earlier = 0; earlier < strip && strips.isFlown(strip); ++earlier) {
      if (!strips.isFlown(earlier) || !map.areCopies(earlier, strip)) continue;
      selection.warnings.push_back("strip " + id(strip) + " holds the same points as strip " +
                                   id(earlier) + " and is excluded: one is a copy of the other");
      exclude(strip, ExclusionReason::copy, map, selection);
    }
  }
}

/// Strips whose firing points are less certain than the trajectory, because their times are
/// rounded.
void excludeRoundedTimes(const BlockIndex& index, double position_std, StripSelection& selection) {
  const BlockStrips& strips = selection.strips;
  std::string last;
  for (int strip = 0; strip < static_cast<int>(strips.size()); ++strip) {
    // Rounding errors are uniformly distributed within a step.
    const double std = index.plausibility().distancePerStep(strip) / std::sqrt(12.0);
    if (!strips.used[static_cast<std::size_t>(strip)] || strips.isFixed(strip) ||
        std < position_std)
      continue;
    char along[80];
    std::snprintf(along, sizeof along, "standard deviation along the flight %.3g m", std);
    last = "strip " + strips.ids[static_cast<std::size_t>(strip)] +
           ": its GPS times are rounded to " + index.plausibility().timeSteps(strip) + ", " +
           along + "; lever_arm_y and boresight_pitch would be wrong";
    exclude(strip, ExclusionReason::rounded_times, index.map(), selection);
    selection.warnings.push_back(last +
                                 ": the strip is excluded; give files with the original times");
  }
  if (last.empty() || std::count(strips.used.begin(), strips.used.end(), true) > 1) return;
  throw InputError(last + ": fewer than two strips are left; give files with the original times");
}

/// The pairs that were asked for, the strip with the smaller index first.
std::vector<StripPair> wantedPairs(const BlockStrips& strips, const BlockRequest& request) {
  std::vector<StripPair> wanted;
  for (const auto& [a, b] : request.pairs) {
    const int i = strips.named(a), j = strips.named(b);
    if (i == j) throw UsageError("pairs name strip '" + a + "' with itself");
    wanted.emplace_back(std::min(i, j), std::max(i, j));
  }
  return wanted;
}

std::string metres(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Why a reference surface cannot be one of this block; empty where it can.
std::string objectionTo(int reference, const BlockStrips& strips, const SurveyMap& map,
                        const CalibrationSettings& settings) {
  SurveyMap::HeightOffset best;
  int strip = -1;
  for (const SurveyMap::Overlap& overlap : map.overlaps(settings.minimum_overlap)) {
    const auto [a, b] = overlap.strips;
    const int other = a == reference ? b : a;
    if ((a != reference && b != reference) || !strips.isFlown(other)) continue;
    const SurveyMap::HeightOffset found = map.heightOffset({reference, other});
    if (strip >= 0 && found.cells <= best.cells) continue;
    best = found;
    strip = other;
  }
  if (strip < 0)
    return "overlaps no strip by " + metres("%.0f m²", settings.minimum_overlap) +
           " or more: give a surface of this block, in its CRS";
  if (std::abs(best.offset) <= settings.max_normal_distance) return {};
  return "lies " + metres("%.2f m ", std::abs(best.offset)) +
         (best.offset > 0.0 ? "above" : "below") + " strip " +
         strips.ids[static_cast<std::size_t>(strip)] + " (median of " + std::to_string(best.cells) +
         " cells of 10 m): its heights are in another unit, or refer to another vertical datum";
}

}  // namespace

StripSelection selectStrips(const BlockStrips& strips, const BlockIndex& index,
                            const BlockRequest& request) {
  StripSelection selection{strips, {}, {}};
  excludeUnpaired(request, selection.strips);
  excludeSmall(index.map(), request.settings.minimum_points, selection);
  excludeCopies(index.map(), selection);
  excludeRoundedTimes(index, request.settings.shared_errors.position, selection);
  return selection;
}

std::vector<StripPair> choosePairs(const BlockStrips& strips, const SurveyMap& map,
                                   const BlockRequest& request, Warnings& warnings) {
  const std::vector<StripPair> wanted = wantedPairs(strips, request);
  const auto is_in = [](const std::vector<StripPair>& pairs, const StripPair& pair) {
    return std::find(pairs.begin(), pairs.end(), pair) != pairs.end();
  };
  std::vector<StripPair> pairs;
  for (const SurveyMap::Overlap& overlap : map.overlaps(request.settings.minimum_overlap)) {
    const auto [first, second] = overlap.strips;
    if (!strips.used[static_cast<std::size_t>(first)] ||
        !strips.used[static_cast<std::size_t>(second)])
      continue;
    const bool a = strips.isFixed(first), b = strips.isFixed(second);
    if (a && b) continue;
    if (a || b || wanted.empty() || is_in(wanted, overlap.strips)) pairs.push_back(overlap.strips);
  }
  for (const StripPair& pair : wanted)
    if (!is_in(pairs, pair))
      warnings.push_back("strips " + strips.ids[static_cast<std::size_t>(pair.first)] + " and " +
                         strips.ids[static_cast<std::size_t>(pair.second)] +
                         " do not overlap enough");
  if (!pairs.empty() || !request.control.empty()) return pairs;
  throw InputError(
      std::count(strips.used.begin(), strips.used.end(), true) < 2
          ? "fewer than two strips with enough points and no control: nothing to compare"
          : "no two strips overlap and there is no control: nothing to compare");
}

void checkReferences(const BlockStrips& strips, const SurveyMap& map,
                     const CalibrationSettings& settings) {
  for (int strip = 0; strip < static_cast<int>(strips.size()); ++strip) {
    if (!strips.isReference(strip)) continue;
    const std::string objection = objectionTo(strip, strips, map, settings);
    if (!objection.empty())
      throw InputError("reference surface " + strips.ids[static_cast<std::size_t>(strip)] + ": " +
                       objection);
  }
}

}  // namespace pcl_als
