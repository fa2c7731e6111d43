// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <pcl_als/calibration/pairing_rules.h>
#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/shared_vectors.h>
#include <pcl_als/common/statistics.h>

#include "calibration_judgement.h"
#include "calibration_report.h"
#include "calibration_state.h"
#include "chosen_parameters.h"
#include "control_consistency.h"
#include "error_diagnosis.h"
#include "misfit_comparison.h"
#include "pair_coverage.h"
#include "pair_weights.h"
#include "strip_error_check.h"
#include "system_groups.h"

namespace pcl_als {
namespace {

// Weightings of the first set of pairs, which has no previous weights; later sets begin with the
// weights of the previous one.
constexpr int kFirstWeightings = 3;
constexpr std::size_t kEnoughForScale = 30;
// times the median of plain ground: rougher neighbourhoods are no planes
constexpr double kRoughnessFactor = 3.0;

}  // namespace

SystemCalibrationEngine::SystemCalibrationEngine(std::shared_ptr<const Trajectory> trajectory,
                                                 const CalibrationSettings& settings,
                                                 const Eigen::Vector2d& anchor)
    : trajectory_(std::move(trajectory)),
      settings_(settings),
      map_(anchor),
      plausibility_(trajectory_) {
  settings_.noise.validate();
  settings_.shared_errors.validate();
  if (trajectory_->hasAttitude()) attitude_ = AttitudeSource::trajectory;
  if (trajectory_->attitudeIsNominal()) attitude_ = AttitudeSource::nominal;
}

SystemCalibrationEngine::~SystemCalibrationEngine() = default;

std::size_t SystemCalibrationEngine::loadedPoints() const {
  if (areShared(processes_)) return loaded_points_;
  std::size_t count = 0;
  for (const AreaMatcher& matcher : matchers_) count += matcher.pointCount();
  return count;
}

std::size_t SystemCalibrationEngine::prepare() {
  if (area_shares_.count() != matchers_.size())
    area_shares_ = SharedItems(nullptr, std::vector<double>(matchers_.size(), 1.0));
  distributeRounded();
  const Candidates candidates = candidatesOfStrips();
  std::vector<std::vector<double>> roughness(matchers_.size());
  forOwnAreas([&](std::size_t i) {
    const bool control = i >= pair_areas_;
    if (rosette_ && !control) matchers_[i].evenOut();
    matchers_[i].prepare(settings_.patches, control ? 0 : candidates.per_strip,
                         settings_.resolution, *trajectory_);
    matchers_[i].collectRoughness(roughness[i]);
  });
  shareVectors(processes_, area_shares_, roughness);
  std::vector<double> all;
  for (const auto& values : roughness) all.insert(all.end(), values.begin(), values.end());
  if (all.empty()) return candidates.pairs;
  const double plain = medianInPlace(all);
  const double most = std::min(settings_.patches.roughness, kRoughnessFactor * plain);
  for (AreaMatcher& matcher : matchers_) matcher.limitRoughness(most, plain);
  return candidates.pairs;
}

void SystemCalibrationEngine::weigh(State& state) const {
  PairWeights::Residuals residuals(state.observations.size());
  parallelFor(residuals.size(), settings_.threads, [&](std::size_t area) {
    residuals[area].reserve(state.observations[area].size());
    for (const PairObservation& o : state.observations[area])
      residuals[area].emplace_back(o,
                                   state.adjustment.residual(o, state.choice.solution) - o.offset);
  });
  // A selection is not representative: it consists mostly of slopes far from the flight line.
  if (state.all()) state.weights.findScales(residuals, settings_.threads);
  state.weights.update(residuals, state.solved(), settings_.threads);
  state.weighed = true;
}

void SystemCalibrationEngine::chooseParametersOf(State& state) const {
  std::vector<SystemParameter> wanted =
      settings_.estimate.empty() ? automaticParameters(control_covered_, settings_.shared_errors)
                                 : settings_.estimate;
  const auto left_out = [&](SystemParameter p) { return state.excluded.count(p) > 0; };
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(), left_out), wanted.end());
  if (state.isCoarse()) {
    state.choice.estimate = wanted;
    state.choice.solution = state.adjustment.solveNearZero(wanted, widePriorStd());
  } else {
    // Parameters requested by name are left out at three times their limit only.
    const double factor = settings_.estimate.empty() ? 1.0 : 3.0;
    std::vector<SystemParameter> unknown;
    const bool known = settings_.shared_errors.biases.of(SystemParameter::range_bias);
    if (settings_.estimate.empty() && !control_covered_ && !known &&
        !left_out(SystemParameter::range_bias)) {
      unknown.push_back(SystemParameter::range_bias);
    }
    for (const auto& [p, reason] : state.excluded) unknown.push_back(p);
    state.choice = chooseParameters(state.adjustment, wanted, SystemVector::Zero(),
                                    settings_.limits, factor, unknown);
    for (const auto& [p, reason] : state.excluded) {
      state.choice.status[indexOf(p)] = ParameterStatus::not_estimable;
      state.choice.reason[indexOf(p)] = reason;
    }
  }
}

void SystemCalibrationEngine::choose(State& state) const {
  chooseParametersOf(state);
  while (!state.isCoarse() && systems_.count > 1 &&
         shareUndetermined(state.adjustment, state.choice, settings_.limits, state.errors)) {
    state.adjustment.setLevels(state.adjustment.levels());
    chooseParametersOf(state);
  }
  state.differences = systemDifferences(state.errors, state.choice.solution.shared);
  if (state.phase == State::Phase::initial) state.phase = State::Phase::coarse;
  state.weighed = false;
}

void SystemCalibrationEngine::adjust(State& state, bool estimate_components) const {
  const int weightings = state.solved() ? 1 : kFirstWeightings;
  for (int i = 0; i < weightings; ++i) {
    if (!state.weighed) weigh(state);
    state.adjustment.accumulate(state.observations, state.weights.weights());
    choose(state);
  }
  if (estimate_components && !state.choice.estimate.empty()) {
    const SharedErrorLevels levels = state.adjustment.levels();
    constexpr double kFirst = 0.05, kLater = 0.02;  // tolerances: another estimation follows
    const EstimatedLevels estimated =
        estimateLevels(state.adjustment, state.choice.estimate, state.components.most_likely,
                       state.components.estimates > 1 ? kLater : kFirst);
    state.components.unchanged = estimated.expected.near(levels);
    state.components.most_likely = estimated.most_likely;
    choose(state);
  }
  weigh(state);
}

void SystemCalibrationEngine::shrinkThreshold(State& state) const {
  constexpr double kSmallest = 0.25;  // metres
  constexpr double kFactor = 6.0;
  if (state.threshold <= kSmallest) return;
  double widest = 0.0;
  setSystemEffects(state.errors, state.differences, state.observations);
  std::map<PairWeights::Group, std::vector<double>> distances;
  for (const AreaObservations& area : state.observations) {
    for (const PairObservation& o : area) {
      distances[PairResidual::groupOf(o)].push_back(o.distance(state.choice.solution.biases));
    }
  }
  for (const auto& [group, values] : distances) {
    if (values.size() >= kEnoughForScale) widest = std::max(widest, robustSigma(values));
  }
  state.threshold = std::clamp(kFactor * widest, kSmallest, state.threshold);
}

namespace {

/// Sets the height and the swath of the strips from the patches of their pairs.
void measureStrips(const std::vector<AreaObservations>& observations,
                   std::vector<FlownStrip>& strips) {
  std::vector<std::vector<double>> heights(strips.size());
  for (const AreaObservations& area : observations) {
    for (const PairObservation& o : area) {
      const auto strip = static_cast<std::size_t>(o.b);
      heights[strip].push_back(o.height);
      strips[strip].half_angle =
          std::max(strips[strip].half_angle, std::atan2(o.lateral, o.height));
    }
  }
  for (std::size_t i = 0; i < strips.size(); ++i)
    if (!heights[i].empty()) strips[i].height = medianInPlace(heights[i]);
}

}  // namespace

void SystemCalibrationEngine::keepAdjusted(State& state, const std::vector<TimeSpan>& spans) {
  adjusted_.strips.clear();
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const int strip = static_cast<int>(i);
    // Strips that are held fixed are control there.
    adjusted_.strips.push_back(
        {ids_[i], isHeld(strip) ? TimeSpan(0.0, 0.0) : spans[i], map_.pointCount(strip)});
  }
  if (replaceHeld(state.observations)) state.moved = HUGE_VAL;  // not to be used for fits
  measureStrips(state.observations, adjusted_.strips);
  adjusted_.sample = thinned(state.observations, state.weights.weights(), kRepresentative);
  adjusted_.levels = state.adjustment.levels();
}

std::vector<std::vector<TimeSpan>> SystemCalibrationEngine::measuredTimes() const {
  using StripSpan = std::pair<int, TimeSpan>;
  std::vector<std::vector<StripSpan>> spans(matchers_.size());
  for (const std::size_t area : area_shares_.ownItems()) {
    for (int strip = 0; strip < static_cast<int>(ids_.size()); ++strip) {
      if (isReference(strip)) continue;
      for (const TimeSpan& span : matchers_[area].timesOf(strip))
        spans[area].emplace_back(strip, span);
    }
  }
  shareVectors(processes_, area_shares_, spans);
  std::vector<std::vector<TimeSpan>> times(ids_.size());
  for (const std::vector<StripSpan>& of_area : spans)
    for (const auto& [strip, span] : of_area)
      times[static_cast<std::size_t>(strip)].push_back(span);
  return times;
}

double SystemCalibrationEngine::meanSpeed(const std::vector<TimeSpan>& spans) const {
  double length = 0.0, duration = 0.0;
  for (const auto& [from, to] : spans) {
    SensorPose start, end;
    std::size_t cursor = 0;
    if (!trajectory_->poseAt(from, start, cursor) || !trajectory_->poseAt(to, end, cursor))
      continue;
    length += (end.position - start.position).norm();
    duration += to - from;
  }
  return duration > 0.0 ? length / duration : 0.0;
}

std::vector<TimeSpan> SystemCalibrationEngine::flownTimes() const {
  std::vector<TimeSpan> spans;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const int strip = static_cast<int>(i);
    spans.push_back(used_[i] && !isReference(strip)
                        ? std::pair(map_.startTime(strip), map_.endTime(strip))
                        : std::pair(0.0, 0.0));
  }
  return spans;
}

void SystemCalibrationEngine::iterateToConvergence(State& state, CalibrationResult& result) {
  constexpr int kMostSelections = 3;
  constexpr std::size_t kEnough = 20'000;  // pairs; determine the biases to some millimetres
  // A selection of pairs represents all of them.
  samplePairs(state, settings_.pair_budget > 0 ? std::numeric_limits<std::size_t>::max() : kEnough);
  for (int selections = 0; selections == 0 || !result.converged; ++selections) {
    while (mayContinue(state, result)) {
      iterate(state, result);
      if (!result.converged && state.arePairsOutdated()) formPairs(state);
    }
    if (!result.converged || !selectSources(state) || selections == kMostSelections) break;
    continueWithSources(state, result);
  }
}

ErrorLevels SystemCalibrationEngine::errorLevels(const State& state) const {
  const NoiseModel& noise = settings_.noise;
  const double scale = state.weights.meanScale();
  const double pointing = scale * std::sqrt(state.weights.pointingFactor());
  const auto trajectory = state.errors.variances(state.adjustment.levels());
  ErrorLevels levels;
  levels.range = scale * noise.range;
  // The scatter on slopes shows the sum of both: all of it is assigned to the direction, and the
  // share of the footprint also to the range.
  levels.angle = pointing * std::hypot(noise.angle, noise.footprint());
  levels.footprint = pointing * noise.footprint();
  levels.position = scale * noise.position;
  levels.trajectory_position = std::sqrt(trajectory[0]);
  levels.trajectory_roll_pitch = std::sqrt(trajectory[3]);
  levels.trajectory_heading = std::sqrt(trajectory[5]);
  return levels;
}

void SystemCalibrationEngine::addFits(State& state, const CalibrationReport& report,
                                      CalibrationResult& result) {
  const std::vector<AreaUse> used = state.usedAreas();
  addFarPairs(state);
  // The fits are those of points corrected by what the result states, not by the solution.
  setSystemEffects(state.errors, statedDifferences(result, systems_, state.differences),
                   state.observations);
  for (AreaObservations& area : state.observations)
    addSourceEffects(result.sources - state.held_sources, area);
  report.addControlPoints(control_, state.observations, used,
                          std::sqrt(state.errors.variances(state.adjustment.levels())[0]), result);
  report.addStripFit(state.observations, state.adjustment, state.choice.solution, result);
  report.addFit(state.observations, result.biases(), true, result);
  addHeldFit(state.observations, result.biases(), true, result);
  warnOfTargets(result);
}

void SystemCalibrationEngine::judge(State& state, const SharedErrors& errors,
                                    const std::vector<PriorEffect>& effects,
                                    const std::string& not_converged,
                                    CalibrationResult& result) const {
  diagnose(result);
  assessControl(state, errors, result);
  assessHeight(height_error_, settings_, result);  // a cause of the errors that follow
  assessStripErrors(settings_, effects, height_error_, result);
  judgeCalibration(settings_.estimate, not_converged, result);
  assessParts(state, result);  // larger standard deviations must not make a result usable
  judgePairCoverage(overlappingPairs(), settings_.max_normal_distance, result);
  nameUndetermined(swathEdge(state.observations), settings_.limits.on_points, result);
}

CalibrationResult SystemCalibrationEngine::calibrate() {
  constexpr std::size_t kEnoughForMisfit = 100'000;  // pairs of the points as delivered
  const std::size_t pairs = prepare();
  const std::vector<TimeSpan> spans = flownTimes();
  const std::vector<std::vector<TimeSpan>> observed = measuredTimes();
  SharedErrors errors(spans, settings_.shared_errors.withKnotsFor(observed), observed, systems_);
  State state(errors, settings_.threads);
  state.choice.solution = state.adjustment.unsolved(SystemVector::Zero());
  state.threshold = settings_.max_normal_distance;
  CalibrationResult result;
  state.sampling = std::max<std::size_t>(1, pairs / kEnoughForMisfit);
  formPairs(state);
  startWithBlockOffset(state);
  warnOfUncoveredControl(state);
  const CalibrationReport report(ids_, !control_covered_);
  report.addFit(state.observations, SystemVector::Zero(), false, result);
  addHeldFit(state.observations, SystemVector::Zero(), false, result);
  const MisfitComparison misfit(state.observations);
  iterateToConvergence(state, result);
  allowForUndecidedSources(state);
  const bool open = !result.converged;
  result.sigma0 = state.weights.sigma0();
  result.redundancy = state.redundancy();
  result.warnings = warnings_;
  result.left_out = left_out_;
  result.attitude = attitude_;
  result.recovered_attitude = recovered_attitude_;
  result.scan_planes = trajectory_->scanPlanes();
  result.line_fit_half_width = trajectory_->lineFitHalfWidth();
  report.addParameters(state.choice, settings_.estimate, result);
  addSystems(state.adjustment, errors, state.choice, settings_.systems, ids_, result);
  report.addStrips(errors, correctedStrips(), state.adjustment, state.choice, result);
  result.error_levels = errorLevels(state);
  addErrorSources(errors, state.choice, state.diagnosed, swathEdge(state.observations),
                  source_scale_, meanSpeed(spans), result);
  addHeldSources(state.held_sources, result);
  judgeBlockOffset(state, result);
  stateReferenceIntensity(result);
  const std::vector<PriorEffect> effects = priorEffects(
      largeStripErrors(result.strip_errors, settings_.shared_errors, kNoticeableCorrection), ids_,
      errors, state.adjustment, state.choice);
  checkHeldHeights(state, errors, result);
  diagnoseParts(state, errors, swathEdge(state.observations), result);
  if (!result.converged) weigh(state);  // the last pairs are newer than their weights
  information_ = state.adjustment.informationShares(state.choice.estimate);
  information_.resize(areas_.size(), 0.0);
  keepAdjusted(state, spans);
  addFits(state, report, result);
  result.misfit = misfit.change(state.observations, result.biases());
  judge(state, errors, effects, open ? reasonNotConverged(state, result) : "", result);
  return result;
}

}  // namespace pcl_als
