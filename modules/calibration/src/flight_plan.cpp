// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <map>
#include <set>

#include <pcl_als/calibration/flight_plan.h>
#include <pcl_als/common/errors.h>

#include "block_advice.h"

namespace pcl_als {
namespace {

std::vector<FlightPlanResult::Overlap> overlapsOf(const ObservedBlock& block) {
  std::map<std::pair<int, int>, FlightPlanResult::Overlap> overlaps;
  for (std::size_t area = 0; area < block.observations.size(); ++area) {
    std::set<std::pair<int, int>> here;
    for (std::size_t i = 0; i < block.observations[area].size(); ++i) {
      const PairObservation& o = block.observations[area][i];
      if (o.a == PairObservation::kControl) continue;
      here.insert({o.a, o.b});
      overlaps[{o.a, o.b}].pairs += block.weights[area][i];
    }
    for (const auto& pair : here) ++overlaps[pair].areas;
  }
  std::vector<FlightPlanResult::Overlap> list;
  for (auto& [strips, overlap] : overlaps) {
    overlap.a = block.strips[static_cast<std::size_t>(strips.first)].id;
    overlap.b = block.strips[static_cast<std::size_t>(strips.second)].id;
    list.push_back(overlap);
  }
  return list;
}

/// Warnings of a plan, in place of those of a calibration.
void warn(FlightPlanResult& result) {
  Warnings& warnings = result.expected.warnings;
  warnings.clear();
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = result.expected[info.parameter];
    if (estimate.status != ParameterStatus::not_estimable) continue;
    warnings.push_back(std::string(info.name) + " will not be determined: " + estimate.reason);
  }
  if (result.control_points == 0) {
    warnings.push_back(
        {"without control the absolute height of the block will not be checked", Hint::control});
  }
}

ObservabilitySettings adjustmentOf(const FlightPlan::Settings& plan) {
  ObservabilitySettings settings;
  settings.estimate = plan.estimate;
  settings.shared_errors = plan.shared_errors;
  settings.pairs.noise = plan.noise;
  settings.pairs.surface = plan.surface;
  settings.pairs.control_sigma = plan.control_sigma;
  settings.planned = true;
  settings.threads = plan.threads;
  return settings;
}

ObservedBlock synthesised(const std::vector<StripGeometry>& lines, std::size_t control_points,
                          const SyntheticPairs& pairs) {
  ObservedBlock block;
  for (const StripGeometry& line : lines) SyntheticPairs::addStrip(line, block);
  pairs.addPairs(0, block);
  for (const Eigen::Vector2d& place : SyntheticPairs::spread(control_points, lines)) {
    pairs.addControl(place, block);
  }
  if (block.observationCount() > 0) return block;
  throw InputError(lines.size() < 2
                       ? "one line and no control: there is nothing to compare"
                       : "no two lines overlap and there is no control: nothing to compare");
}

}  // namespace

FlightPlan::FlightPlan(std::vector<StripGeometry> lines, const Settings& settings)
    : lines_(std::move(lines)), settings_(settings) {
  constexpr std::size_t kMostLines = 200;
  if (lines_.empty()) throw UsageError("a flight plan needs at least one line");
  if (lines_.size() > kMostLines) {
    throw UsageError("a flight plan of " + std::to_string(lines_.size()) +
                     " lines: at most 200 can be planned together");
  }
  std::set<std::string> ids;
  for (const StripGeometry& line : lines_) {
    line.validate();
    if (!ids.insert(line.id).second) throw UsageError("two lines are called '" + line.id + "'");
  }
  settings_.noise.validate();
  settings_.surface.validate();
  settings_.shared_errors.validate();
}

FlightPlanResult FlightPlan::evaluate() const {
  const ObservabilitySettings settings = adjustmentOf(settings_);
  ObservedBlock block =
      synthesised(lines_, settings_.control_points, SyntheticPairs(settings.pairs));
  const BlockAdjustment adjusted(block, settings);
  FlightPlanResult result;
  result.lines = lines_;
  result.overlaps = overlapsOf(block);
  result.control_points = block.control_points;
  result.expected.converged = true;
  reportParameters(adjusted.choice(), settings_.estimate, result.expected);
  warn(result);
  WeightedObservations few = thinned(block.observations, block.weights, kRepresentative);
  block.observations = std::move(few.observations);
  block.weights = std::move(few.weights);
  result.observability = describeObservability(block, settings);
  return result;
}

}  // namespace pcl_als
