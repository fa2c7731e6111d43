// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The error sources of SystemCalibrationEngine: which of them the data support.
#include <algorithm>
#include <cmath>

#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/shared_vectors.h>
#include <pcl_als/common/statistics.h>

#include "angle_curve.h"
#include "calibration_state.h"
#include "chosen_parameters.h"
#include "error_diagnosis.h"
#include "group_differences.h"
#include "jump_search.h"

namespace pcl_als {
namespace {

// metres: standard deviation of the range bias of a mounted system, where an offset of the block
// may take its place
constexpr double kRangeBias = 0.25;

/// A parameter that the block does not determine, or that was not asked for, must not appear as an
/// error with a similar effect: it has a wide prior. With control, where an offset of the block is
/// a hypothesis, the range bias has one as well, and lever_arm_z, which has the effect of such an
/// offset, is left to it.
AdjustmentSolution solveForAllParameters(const Adjustment& adjustment,
                                         const std::vector<SystemParameter>& estimated,
                                         bool to_control) {
  SystemVector std = widePriorStd();
  for (const SystemParameter p : estimated) std[indexOf(p)] = HUGE_VAL;
  if (to_control) std[indexOf(SystemParameter::range_bias)] = kRangeBias;
  std::vector<SystemParameter> parameters;
  for (const SystemParameterInfo& info : systemParameters()) {
    const bool is_offset = info.parameter == SystemParameter::lever_arm_z && to_control;
    if (!is_offset || std::isinf(std[indexOf(info.parameter)]))
      parameters.push_back(info.parameter);
  }
  return adjustment.solve(parameters, SystemVector::Zero(), std.cwiseAbs2().cwiseInverse());
}

std::vector<ErrorSource> concernedSources(const ErrorSourceScale& scale) {
  std::vector<ErrorSource> sources;
  for (const ErrorSourceInfo& info : errorSources())
    if (scale.concerns(info.source)) sources.push_back(info.source);
  return sources;
}

}  // namespace

void SystemCalibrationEngine::considerSources() {
  if (source_scale_.largest_angle > 0.0) return;
  std::vector<std::vector<double>> found(matchers_.size());  // angle, then intensities
  for (const std::size_t i : area_shares_.ownItems()) {
    if (i >= pair_areas_) continue;
    double angle = 0.0;
    found[i].push_back(angle);
    matchers_[i].collectSourceScale(*trajectory_, angle, found[i]);
    found[i].front() = angle;
  }
  shareVectors(processes_, area_shares_, found);
  std::vector<double> intensities;
  for (std::size_t i = 0; i < pair_areas_; ++i) {
    source_scale_.largest_angle = std::max(source_scale_.largest_angle, found[i].front());
    intensities.insert(intensities.end(), found[i].begin() + 1, found[i].end());
  }
  source_scale_.to_control = control_covered_;
  if (!intensities.empty()) source_scale_.median_intensity = medianInPlace(intensities);
  for (AreaMatcher& matcher : matchers_) matcher.considerSources(source_scale_);
}

bool SystemCalibrationEngine::selectSources(State& state) {
  if (!settings_.diagnose || !state.choice.solution.solved || state.observationCount() == 0 ||
      !state.held_sources.isZero(0.0))
    return false;
  pairAllCandidates(state);  // with the effects of all sources, since the coarse phase
  const std::vector<ErrorSource> before = state.errors.consideredSources();
  state.errors.considerSources(concernedSources(source_scale_));
  if (!state.weighed) weigh(state);
  state.adjustment.accumulate(state.observations, state.weights.weights());
  state.diagnosed =
      solveForAllParameters(state.adjustment, state.choice.estimate, source_scale_.to_control);
  std::vector<ErrorSource> supported{ErrorSource::slope_ranging};
  for (const ErrorSource source : concernedSources(source_scale_)) {
    if (isCorrected(source, state.diagnosed, settings_.shared_errors)) supported.push_back(source);
  }
  if (settings_.pair_budget > 0) {
    for (const ErrorSource source : supported) {
      if (source != ErrorSource::slope_ranging)
        state.held_sources[indexOf(source)] =
            state.diagnosed.shared[state.errors.sourceUnknown(source)];
    }
    supported = before;
  }
  state.errors.considerSources(supported);
  state.adjustment.setLevels(state.adjustment.levels());
  choose(state);
  const bool changed = supported != before || !state.held_sources.isZero(0.0);
  if (changed) state.moved = HUGE_VAL;  // they are removed from the points
  return changed;
}

void SystemCalibrationEngine::allowForUndecidedSources(State& state) const {
  if (!state.diagnosed.solved || !state.choice.solution.solved) return;
  for (const ErrorSource source : concernedSources(source_scale_)) {
    const int i = indexOf(source);
    if (state.errors.isConsidered(source) || state.held_sources[i] != 0.0 ||
        !isPossible(source, state.diagnosed, settings_.shared_errors))
      continue;
    const double square = state.diagnosed.source_value[i] * state.diagnosed.source_value[i] +
                          state.diagnosed.source_std[i] * state.diagnosed.source_std[i];
    const SystemVector derivative =
        state.adjustment.derivativeBySource(source, state.choice.estimate);
    state.choice.solution.covariance +=
        state.diagnosed.source_probability[i] * square * derivative * derivative.transpose();
  }
}

ErrorSourceVector SystemCalibrationEngine::sourcesOf(const State& state) {
  ErrorSourceVector values = state.held_sources;
  for (const ErrorSource source : state.errors.consideredSources()) {
    if (source != ErrorSource::slope_ranging)
      values[indexOf(source)] += state.choice.solution.shared[state.errors.sourceUnknown(source)];
  }
  return values;
}

void SystemCalibrationEngine::diagnoseParts(State& state, SharedErrors& errors,
                                            const ScanGeometry& edge,
                                            CalibrationResult& result) const {
  if (result.diagnosis.empty()) return;  // not asked for, or not solved
  std::vector<JumpSearch::Strip> strips;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const int strip = static_cast<int>(i);
    if (used_[i] && !isHeld(strip) && systems_.pass[i] == strip) strips.push_back({strip, ids_[i]});
  }
  const JumpSearch jumps(
      errors, state.adjustment,
      solveForAllParameters(state.adjustment, state.choice.estimate, source_scale_.to_control),
      strips);
  const ErrorFinding& jump = jumps.finding();
  result.diagnosis.push_back(jump);
  if (jump.determined && jump.probability > kSupported)
    result.warnings.push_back(jump.title + ": " + jump.evidence + "; " + jump.remedy);
  const std::size_t before = result.diagnosis.size();
  if (!compared_.empty())
    addGroupDifferences(compared_, strips.size(), edge, state.choice, errors, state.adjustment,
                        result.diagnosis);
  judgeDifferences(before, settings_.shared_errors.position, Remedy::none, result);
  diagnoseFields(state, edge, result);
  diagnoseAngles(state, edge, result);
}

void SystemCalibrationEngine::diagnoseAngles(const State& state, const ScanGeometry& edge,
                                             CalibrationResult& result) const {
  // Other beams have no single angle, and parts of such blocks have parameters of their own.
  if (!result.converged || conical_ || rosette_ || !trajectory_->scanPlanes().empty() ||
      !held_.empty() || !settings_.systems.empty() || !(source_scale_.largest_angle > 0.0))
    return;
  const AdjustedBlock block{flownTimes(), settings_.shared_errors, state.adjustment.levels(),
                            state.choice.estimate, settings_.threads};
  judgeAngleCurve(angleCurve(block, {state.observations, state.weights.weights()},
                             state.errors.consideredSources(), source_scale_.largest_angle, edge),
                  settings_.shared_errors.position, result);
}

void SystemCalibrationEngine::continueWithSources(State& state, CalibrationResult& result) {
  state.phase = State::Phase::refinement;
  const SharedErrorLevels most_likely = state.components.most_likely;
  state.components = {};
  state.components.most_likely = most_likely;
  state.coarse_iterations = static_cast<int>(result.iterations.size());
  result.converged = false;
}

}  // namespace pcl_als
