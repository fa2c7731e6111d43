// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "matched_block.h"

#include <algorithm>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/survey/area_index.h>
#include <pcl_als/trajectory/bias_evaluator.h>

#include "pair_observation.h"

namespace pcl_als::bench {

MatchedBlock::MatchedBlock(const test::SimulatedSurvey& survey, const SurveyBlock& block)
    : flight_(block.flight.trajectory),
      pairs_(block.pairs),
      control_(block.request.control),
      pair_areas_(block.pairAreas()),
      limits_(block.settings().patches) {
  load(survey, block.areas);
  prepare(block.settings());
  limitRoughness();
}

void MatchedBlock::load(const test::SimulatedSurvey& survey, const std::vector<SurveyArea>& areas) {
  const std::size_t strips = survey.strips.size();
  const AreaIndex index(areas);
  for (const SurveyArea& area : areas) matchers_.emplace_back(area, strips);
  times_.assign(areas.size(), std::vector<std::vector<double>>(strips));
  parallelFor(strips, 0, [&](std::size_t strip) {
    for (const LidarReturn& point : survey.strips[strip]) {
      if (!isSurfacePoint(point)) continue;
      for (const int i : index.candidates(point.position)) {
        const auto area = static_cast<std::size_t>(i);
        if (!areas[area].covers(point.position)) continue;
        matchers_[area].add(static_cast<int>(strip), point);
        times_[area][strip].push_back(point.time);
      }
    }
  });
}

void MatchedBlock::prepare(const CalibrationSettings& settings) {
  std::size_t strips_in_areas = 1, pairs_in_areas = 0;
  for (std::size_t i = 0; i < pair_areas_; ++i) {
    const std::size_t strips = matchers_[i].stripCount();
    strips_in_areas += strips;
    if (strips > 0) pairs_in_areas += strips * (strips - 1);
  }
  const std::size_t candidates =
      candidatesPerStrip(settings.candidates, strips_in_areas, pairs_in_areas);
  parallelFor(matchers_.size(), 0, [&](std::size_t i) {
    matchers_[i].prepare(limits_, i < pair_areas_ ? candidates : 0, settings.resolution, *flight_);
  });
}

void MatchedBlock::limitRoughness() {
  std::vector<double> all;
  for (const AreaMatcher& matcher : matchers_) matcher.collectRoughness(all);
  if (all.empty()) return;
  const double plain = medianInPlace(all);
  limits_.roughness = std::min(limits_.roughness, 3.0 * plain);
  for (AreaMatcher& matcher : matchers_) matcher.limitRoughness(limits_.roughness, plain);
}

void MatchedBlock::correct(const SystemVector& biases) {
  const BiasEvaluator correction(flight_, biases);
  parallelFor(matchers_.size(), 0,
              [&](std::size_t i) { matchers_[i].correct(correction, *flight_); });
}

std::vector<AreaObservations> MatchedBlock::match(double threshold, const NoiseModel& noise) const {
  std::vector<AreaObservations> found(matchers_.size());
  parallelFor(matchers_.size(), 0, [&](std::size_t i) {
    found[i] = i < pair_areas_ ? matchers_[i].match(pairs_, threshold, *flight_, noise)
                               : matchers_[i].matchControl({control_[i - pair_areas_]}, threshold,
                                                           *flight_, noise, 0.0);
  });
  return found;
}

}  // namespace pcl_als::bench
