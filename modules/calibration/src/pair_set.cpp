// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pair_set.h"

#include <algorithm>

#include <pcl_als/common/statistics.h>

#include "area_matcher.h"
#include "error_diagnosis.h"

namespace pcl_als {
namespace {

/// Whether a control point has a patch.
bool isSeen(const AreaObservations& area) {
  return std::any_of(area.begin(), area.end(),
                     [](const PairObservation& o) { return !o.isInPlan(); });
}

bool isAnyPointSeen(const PairSet& pairs, const SurveyBlock& block) {
  const auto first = pairs.observations.begin() + static_cast<std::ptrdiff_t>(block.pairAreas());
  return std::any_of(first, pairs.observations.end(), isSeen);
}

}  // namespace

std::size_t PairSet::count() const {
  std::size_t count = 0;
  for (const AreaObservations& area : observations) count += area.size();
  return count;
}

std::vector<AreaUse> PairSet::used(const std::vector<std::vector<double>>& weights) const {
  std::vector<AreaUse> used(observations.size());
  for (std::size_t area = 0; area < weights.size(); ++area) {
    for (std::size_t i = 0; i < weights[area].size(); ++i) {
      if (!(weights[area][i] > 0.0)) continue;
      (observations[area][i].isInPlan() ? used[area].plan : used[area].heights) = true;
    }
  }
  return used;
}

AreaObservations matchControl(const AreaSample& sample, std::size_t area, double threshold) {
  const SurveyBlock& block = sample.block();
  const CalibrationSettings& settings = block.settings();
  const ControlPoint& point = block.controlOf(area);
  // Strips that agree with each other may all be displaced in plan.
  const bool target = point.kind == ControlPoint::Kind::target;
  return sample.area(area).matchControl({point}, target ? settings.max_normal_distance : threshold,
                                        block.trajectory(), settings.noise, settings.control_sigma);
}

PairSet formPairs(AreaSample& sample, const Corrections& corrections, const PairRules& rules) {
  sample.correct(corrections);
  const SurveyBlock& block = sample.block();
  const CalibrationSettings& settings = block.settings();
  const AreaMatcher::DistanceLimits limits{rules.threshold, settings.max_normal_distance};
  const AreaMatcher::Points points =
      rules.selected ? AreaMatcher::Points::kept : AreaMatcher::Points::candidates;
  PairSet pairs;
  pairs.rules = rules;
  pairs.far.resize(block.areas.size());
  pairs.observations =
      sample.collect<PairObservation>([&](std::size_t i, AreaObservations& observations) {
        if (block.isControl(i)) {
          observations = matchControl(sample, i, rules.threshold);
        } else {
          AreaMatcher::PairsByDistance found = sample.area(i).matchByDistance(
              block.pairs, limits, block.trajectory(), settings.noise, points, rules.sampling);
          observations = std::move(found.near);
          pairs.far[i] = std::move(found.far);
        }
        removeSources(rules.held_sources, observations);
        removeSources(rules.held_sources, pairs.far[i]);
      });
  return pairs;
}

void addFarPairs(AreaSample& sample, const Corrections& corrections, PairSet& pairs) {
  const SurveyBlock& block = sample.block();
  PairRules rules = pairs.rules;
  rules.threshold = block.settings().max_normal_distance;
  if (!rules.isComplete() || pairs.isOutdated()) {
    rules.selected = false;
    rules.sampling = 1;
    pairs = formPairs(sample, corrections, rules);
    return;
  }
  sample.forAreas([&](std::size_t i) {
    if (!block.isControl(i)) return;
    pairs.far[i] = matchControl(sample, i, rules.threshold);
    removeSources(rules.held_sources, pairs.far[i]);
  });
  sample.share(pairs.far);
  for (std::size_t i = 0; i < pairs.far.size(); ++i) {
    AreaObservations& all = pairs.observations[i];
    if (block.isControl(i)) all.clear();
    all.insert(all.end(), pairs.far[i].begin(), pairs.far[i].end());
  }
}

bool isControlCovered(const PairSet& pairs, const SurveyBlock& block) {
  const auto end = pairs.observations.begin() + static_cast<std::ptrdiff_t>(block.pairAreas());
  return isAnyPointSeen(pairs, block) ||
         std::any_of(pairs.observations.begin(), end, [&](const AreaObservations& area) {
           return std::any_of(area.begin(), area.end(),
                              [&](const PairObservation& o) { return block.strips.isFixed(o); });
         });
}

Warnings warningsOfControl(const PairSet& pairs, const SurveyBlock& block) {
  Warnings warnings;
  const std::size_t points = block.request.control.size();
  if (points == 0 || isAnyPointSeen(pairs, block)) return warnings;
  warnings.push_back("none of the " + std::to_string(points) +
                     " control points lies on a smooth surface of a strip: calibrated without "
                     "them" +
                     (block.control_remark.empty() ? "" : "; " + block.control_remark));
  return warnings;
}

ErrorSourceScale sourceScale(const AreaSample& sample, bool to_control) {
  const SurveyBlock& block = sample.block();
  // For each area of pairs the largest angle, then intensities.
  const auto found = sample.collect<double>([&](std::size_t i, std::vector<double>& values) {
    if (block.isControl(i)) return;
    double angle = 0.0;
    values.push_back(angle);
    sample.area(i).collectSourceScale(block.trajectory(), angle, values);
    values.front() = angle;
  });
  ErrorSourceScale scale;
  scale.about_axis = block.scanner.about_axis;
  scale.to_control = to_control;
  std::vector<double> intensities;
  for (std::size_t i = 0; i < block.pairAreas(); ++i) {
    scale.largest_angle = std::max(scale.largest_angle, found[i].front());
    intensities.insert(intensities.end(), found[i].begin() + 1, found[i].end());
  }
  if (!intensities.empty()) scale.median_intensity = medianInPlace(intensities);
  return scale;
}

}  // namespace pcl_als
