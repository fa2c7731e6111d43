// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The pairs of SystemCalibrationEngine: which are formed, and in which geometry.
#include <algorithm>
#include <cmath>
#include <string>

#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/shared_vectors.h>

#include "calibration_state.h"
#include "error_diagnosis.h"
#include "pair_selection.h"

namespace pcl_als {

SystemCalibrationEngine::StripCorrections SystemCalibrationEngine::correctionsOf(
    const State& state) const {
  StripCorrections corrections;
  corrections.sources = sourcesOf(state);
  for (const SystemUnknowns& difference : state.differences) {
    const SystemVector biases =
        state.choice.solution.biases + difference.head<kSystemParameterCount>();
    corrections.of_systems.emplace_back(trajectory_, biases);
  }
  for (std::size_t strip = 0; strip < ids_.size(); ++strip) {
    const auto system = static_cast<std::size_t>(systems_.of(static_cast<int>(strip)));
    corrections.strips.push_back(
        {&corrections.of_systems[system], state.differences[system].tail<3>()});
  }
  return corrections;
}

void SystemCalibrationEngine::correctPoints(State& state) {
  const ErrorSourceVector sources = sourcesOf(state);
  const bool unchanged = state.corrected == state.choice.solution.biases &&
                         state.corrected_differences == state.differences &&
                         state.corrected_sources == sources;
  if (unchanged || (!state.solved() && sources.isZero(0.0))) return;
  state.corrected = state.choice.solution.biases;
  state.corrected_differences = state.differences;
  state.corrected_sources = sources;
  const StripCorrections corrections = correctionsOf(state);
  forOwnAreas(
      [&](std::size_t i) { matchers_[i].correct(corrections.strips, sources, *trajectory_); });
}

void SystemCalibrationEngine::selectPairs(State& state) {
  PairSelectionSettings settings;
  settings.budget = settings_.pair_budget;
  const PairSelection selection(state.observations, state.weights.weights(), state.adjustment,
                                state.choice.solution, settings);
  forOwnAreas([&](std::size_t i) {
    if (i < pair_areas_) matchers_[i].keep(state.observations[i], selection.chosen()[i]);
  });
  state.chosen_points = AreaMatcher::Points::kept;
  state.moved = HUGE_VAL;
}

void SystemCalibrationEngine::formPairs(State& state) {
  correctPoints(state);
  state.moved = 0.0;
  state.weighed = false;
  state.observations.assign(matchers_.size(), {});
  state.far.assign(matchers_.size(), {});
  const AreaMatcher::DistanceLimits limits{state.threshold, settings_.max_normal_distance};
  forOwnAreas([&](std::size_t i) {
    if (i < pair_areas_) {
      AreaMatcher::PairsByDistance found = matchers_[i].matchByDistance(
          pairs_, limits, *trajectory_, settings_.noise, state.chosen_points, state.sampling);
      state.observations[i] = std::move(found.near);
      state.far[i] = std::move(found.far);
    } else {
      state.observations[i] = matchControl(i, state.threshold);
    }
    removeSources(state.held_sources, state.observations[i]);
    removeSources(state.held_sources, state.far[i]);
  });
  shareVectors(processes_, area_shares_, state.observations);
}

void SystemCalibrationEngine::addFarPairs(State& state) {
  state.threshold = settings_.max_normal_distance;
  if (!state.all() || state.isSampled() || state.arePairsOutdated()) {
    formAllPairs(state);
    return;
  }
  forOwnAreas([&](std::size_t i) {
    if (i < pair_areas_) return;
    state.far[i] = matchControl(i, state.threshold);
    removeSources(state.held_sources, state.far[i]);
  });
  shareVectors(processes_, area_shares_, state.far);
  for (std::size_t i = 0; i < matchers_.size(); ++i) {
    AreaObservations& all = state.observations[i];
    if (i >= pair_areas_) all.clear();
    all.insert(all.end(), state.far[i].begin(), state.far[i].end());
  }
}

AreaObservations SystemCalibrationEngine::matchControl(std::size_t area, double threshold) const {
  const ControlPoint& point = control_[area - pair_areas_];
  // Strips that agree with each other may all be displaced in plan.
  const bool target = point.kind == ControlPoint::Kind::target;
  return matchers_[area].matchControl({point}, target ? settings_.max_normal_distance : threshold,
                                      *trajectory_, settings_.noise, settings_.control_sigma);
}

void SystemCalibrationEngine::warnOfUncoveredControl(const State& state) {
  const auto seen = [](const AreaObservations& area) {
    return std::any_of(area.begin(), area.end(),
                       [](const PairObservation& o) { return !o.isInPlan(); });
  };
  const auto held = [this](const AreaObservations& area) {
    return std::any_of(area.begin(), area.end(),
                       [this](const PairObservation& o) { return isHeld(o); });
  };
  const auto first = state.observations.begin() + static_cast<std::ptrdiff_t>(pair_areas_);
  const bool points = std::any_of(first, state.observations.end(), seen);
  control_covered_ = points || std::any_of(state.observations.begin(), first, held);
  if (control_.empty() || points) return;
  warnings_.push_back("none of the " + std::to_string(control_.size()) +
                      " control points lies on a smooth surface of a strip: calibrated without "
                      "them" +
                      (control_remark_.empty() ? "" : "; " + control_remark_));
}

void SystemCalibrationEngine::samplePairs(State& state, std::size_t pairs) {
  const std::size_t before = state.sampling;
  state.sampling = std::max<std::size_t>(1, before * state.observationCount() / pairs);
  if (state.sampling != before) formPairs(state);
}

void SystemCalibrationEngine::formAllPairs(State& state) {
  state.sampling = 1;
  state.chosen_points = AreaMatcher::Points::candidates;
  formPairs(state);
}

void SystemCalibrationEngine::pairAllCandidates(State& state) {
  if (!state.all() || state.isSampled()) formAllPairs(state);
}

}  // namespace pcl_als
