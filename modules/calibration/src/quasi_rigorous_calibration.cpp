// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <map>

#include <pcl_als/calibration/block_advice.h>
#include <pcl_als/calibration/calibration_judgement.h>
#include <pcl_als/calibration/calibration_report.h>
#include <pcl_als/calibration/misfit_comparison.h>
#include <pcl_als/calibration/pair_selection.h>
#include <pcl_als/calibration/pair_weights.h>
#include <pcl_als/calibration/quasi_rigorous_calibration.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>

#include "pairing_rules.h"

namespace pcl_als {
namespace {

// Weightings of the first set of pairs, which begin with nothing known; later sets begin with the
// weights of the last.
constexpr int kFirstWeightings = 3;
constexpr std::size_t kEnoughForScale = 30;
constexpr double kRoughnessFactor = 3.0;  // times the median on plain ground: more is not a plane

/// Biases of a system nobody has calibrated (standard deviations): half a degree, metres.
SystemVector largestBelievable() {
  constexpr double kAngle = 0.5 * kRadiansPerDegree;
  SystemVector sigma;
  sigma << 1.0, 1.0, 1.0, kAngle, kAngle, kAngle, 1.0, 2e-3;
  return sigma;
}

}  // namespace

/// What changes from iteration to iteration.
struct QuasiRigorousCalibration::State {
  explicit State(const SharedErrors& errors, int threads) : adjustment(errors, threads) {}

  std::size_t observationCount() const {
    std::size_t count = 0;
    for (const AreaObservations& area : observations) count += area.size();
    return count;
  }
  long redundancy() const {
    return static_cast<long>(weights.kept()) - static_cast<long>(choice.estimate.size());
  }
  /// Whether all pairs are adjusted, not a chosen part of them.
  bool all() const { return seekers == AreaMatcher::Seekers::candidates; }
  /// Whether the levels need no further look.
  bool looked() const {
    constexpr int kLooks = 8;
    return levels_rest || looks >= kLooks;
  }

  Adjustment adjustment;
  ParameterChoice choice;
  /// Whether choice holds a solution: before, residuals are full of what is sought, and none may be
  /// called an outlier for it.
  bool solved = false;
  /// On the way: nothing is left out for being uncertain, for mismatched pairs make all uncertain.
  bool coarse = true;
  bool levels_open = false;  ///< whether this iteration looks for the levels of shared errors
  int looks = 0;             ///< how often it was looked for
  bool levels_rest = false;  ///< whether the last look left them as they were
  AreaMatcher::Seekers seekers = AreaMatcher::Seekers::candidates;
  bool choose_again = false;   ///< of all pairs, in the next iteration
  bool chosen_at_end = false;  ///< whether that was done where all had come to rest, levels too
  double threshold = 0.0;
  std::vector<AreaObservations> observations;
  PairWeights weights;
};

QuasiRigorousCalibration::QuasiRigorousCalibration(std::shared_ptr<const Trajectory> trajectory,
                                                   const CalibrationSettings& settings,
                                                   const Eigen::Vector2d& anchor)
    : trajectory_(std::move(trajectory)),
      settings_(settings),
      map_(anchor),
      plausibility_(trajectory_) {
  settings_.noise.validate();
  settings_.shared_errors.validate();
  if (trajectory_->hasAttitude()) attitude_ = AttitudeSource::trajectory;
}

std::size_t QuasiRigorousCalibration::loadedPoints() const {
  std::size_t count = 0;
  for (const AreaMatcher& matcher : matchers_) count += matcher.pointCount();
  return count;
}

void QuasiRigorousCalibration::prepare() {
  std::size_t strips_in_areas = 1;
  for (std::size_t i = 0; i < pair_areas_; ++i) strips_in_areas += matchers_[i].stripCount();
  const std::size_t candidates = candidatesPerStrip(settings_.candidates, strips_in_areas);
  std::vector<std::vector<double>> roughness(matchers_.size());
  parallelFor(matchers_.size(), settings_.threads, [&](std::size_t i) {
    const bool control = i >= pair_areas_;
    matchers_[i].prepare(settings_.patches, control ? 0 : candidates, settings_.resolution);
    matchers_[i].collectRoughness(roughness[i]);
  });
  std::vector<double> all;
  for (const auto& values : roughness) all.insert(all.end(), values.begin(), values.end());
  if (all.empty()) return;
  const double plain = medianInPlace(all);
  const double most = std::min(settings_.patches.roughness, kRoughnessFactor * plain);
  for (AreaMatcher& matcher : matchers_) matcher.limitRoughness(most, plain);
}

void QuasiRigorousCalibration::pairUp(State& state) const {
  state.observations.assign(matchers_.size(), {});
  parallelFor(matchers_.size(), settings_.threads, [&](std::size_t i) {
    const AreaMatcher& matcher = matchers_[i];
    state.observations[i] =
        i < pair_areas_
            ? matcher.match(pairs_, state.threshold, *trajectory_, settings_.noise, state.seekers)
            : matcher.matchControl({control_[i - pair_areas_]}, state.threshold, *trajectory_,
                                   settings_.noise, settings_.control_sigma);
  });
}

void QuasiRigorousCalibration::lookAtControl(const State& state) {
  const auto seen = [](const AreaObservations& area) { return !area.empty(); };
  const auto first = state.observations.begin() + static_cast<std::ptrdiff_t>(pair_areas_);
  control_seen_ = std::any_of(first, state.observations.end(), seen);
  if (control_.empty() || control_seen_) return;
  warnings_.push_back("none of the " + std::to_string(control_.size()) +
                      " control points lies on a smooth surface of a strip: calibrated without "
                      "control");
}

void QuasiRigorousCalibration::selectPairs(State& state) {
  PairSelectionSettings settings;
  settings.budget = settings_.pair_budget;
  const PairSelection selection(state.observations, state.weights.weights(), state.adjustment,
                                state.choice.solution, settings);
  parallelFor(pair_areas_, settings_.threads, [&](std::size_t i) {
    matchers_[i].keep(state.observations[i], selection.chosen()[i]);
  });
  state.seekers = AreaMatcher::Seekers::kept;
}

void QuasiRigorousCalibration::weigh(State& state) const {
  std::vector<std::vector<double>> residuals(state.observations.size());
  parallelFor(residuals.size(), settings_.threads, [&](std::size_t area) {
    for (const PairObservation& o : state.observations[area]) {
      residuals[area].push_back(state.adjustment.residual(o, state.choice.solution) - o.offset);
    }
  });
  // Chosen pairs are not like all: mostly slopes, far from the line of flight.
  if (state.all()) {
    state.weights.findScales(state.observations, residuals, settings_.threads);
  }
  state.weights.update(state.observations, residuals, state.solved);
}

void QuasiRigorousCalibration::choose(State& state) const {
  const std::vector<SystemParameter> wanted =
      settings_.estimate.empty() ? automaticParameters(control_seen_) : settings_.estimate;
  if (state.coarse) {
    state.choice.estimate = wanted;
    state.choice.solution = state.adjustment.solveNearZero(wanted, largestBelievable());
  } else {
    // What was asked for by name is dropped only when it is hopeless.
    const double factor = settings_.estimate.empty() ? 1.0 : 3.0;
    std::vector<SystemParameter> unknown;
    if (settings_.estimate.empty() && !control_seen_) {
      unknown.push_back(SystemParameter::range_bias);
    }
    state.choice = chooseParameters(state.adjustment, wanted, SystemVector::Zero(),
                                    settings_.limits, factor, unknown);
  }
  state.solved = true;
}

void QuasiRigorousCalibration::adjust(State& state) const {
  const int weightings = state.solved ? 1 : kFirstWeightings;
  for (int i = 0; i < weightings; ++i) {
    weigh(state);
    state.adjustment.accumulate(state.observations, state.weights.weights());
    choose(state);
  }
  if (state.levels_open && !state.choice.estimate.empty()) {
    const SharedErrorLevels levels = state.adjustment.levels();
    state.levels_rest = mostLikelyLevels(state.adjustment, state.choice.estimate).near(levels);
    choose(state);
  }
  weigh(state);
}

namespace {

/// Largest movement of a ground point by a change of the biases, from the design rows of the
/// observations, metres.
double largestEffect(const std::vector<AreaObservations>& observations,
                     const SystemVector& change) {
  double x = 0.0, z = 0.0;
  for (const AreaObservations& area : observations) {
    for (const PairObservation& o : area) {
      x = std::max(x, o.lateral);
      z = std::max(z, o.height);
    }
  }
  ScanGeometry geometry;
  geometry.x = x;
  geometry.z = -z;
  geometry.beta = -std::atan2(x, z);
  return (designBlock(geometry).cwiseAbs() * change.cwiseAbs()).maxCoeff();
}

}  // namespace

void QuasiRigorousCalibration::shrinkThreshold(State& state) const {
  constexpr double kSmallest = 0.25;  // metres
  constexpr double kFactor = 6.0;
  double widest = 0.0;
  std::map<PairWeights::Group, std::vector<double>> distances;
  for (const AreaObservations& area : state.observations) {
    for (const PairObservation& o : area) {
      distances[PairWeights::groupOf(o)].push_back(o.distance(state.choice.solution.biases));
    }
  }
  for (const auto& [group, values] : distances) {
    if (values.size() >= kEnoughForScale) widest = std::max(widest, robustSigma(values));
  }
  state.threshold = std::clamp(kFactor * widest, kSmallest, state.threshold);
}

bool QuasiRigorousCalibration::restsWithin(const State& state, const SystemVector& before) {
  constexpr double kNegligible = 0.05;  // of a standard deviation
  const AdjustmentSolution& solution = state.choice.solution;
  return std::all_of(state.choice.estimate.begin(), state.choice.estimate.end(),
                     [&](SystemParameter p) {
                       const int i = indexOf(p);
                       return std::abs(solution.biases[i] - before[i]) <
                              kNegligible * std::sqrt(solution.covariance(i, i));
                     });
}

void QuasiRigorousCalibration::openIteration(State& state, const CalibrationResult& result) const {
  constexpr double kNearlyAtRest = 0.005;  // metres
  constexpr std::size_t kCoarseAtMost = 12;
  const std::size_t done = result.iterations.size();
  const bool rests =
      done > 0 && (state.choose_again || result.iterations.back().largest_update < kNearlyAtRest);
  const bool arrives = state.coarse && (rests || done >= kCoarseAtMost);
  if (arrives) state.coarse = false;
  // The levels are looked for where the geometry has come to rest, for what is left of the biases
  // looks like errors of the trajectory; and they must rest for the iteration to converge.
  const bool look_due = !state.coarse && rests && !state.looked();
  // Chosen pairs tell what all told where they were chosen: again at their places, and at the end.
  // The noise of the few is no measure of the levels.
  const bool first_look = look_due && state.looks == 0;
  if ((arrives || first_look || state.choose_again) && !state.all()) {
    state.seekers = AreaMatcher::Seekers::candidates;
    pairUp(state);
  }
  state.levels_open = look_due && state.all();
  if (state.levels_open) ++state.looks;
}

void QuasiRigorousCalibration::iterate(State& state, CalibrationResult& result) {
  const SystemVector before = state.choice.solution.biases;
  const std::size_t done = result.iterations.size();
  openIteration(state, result);
  adjust(state);
  state.chosen_at_end = state.chosen_at_end || (state.choose_again && state.looked());
  state.choose_again = false;
  if (settings_.pair_budget > 0 && state.all()) selectPairs(state);
  const SystemVector& biases = state.choice.solution.biases;
  const double effect = largestEffect(state.observations, biases - before);
  result.iterations.push_back({state.observationCount(), state.weights.sigma0(), effect});
  if (progress_) progress_(result.iterations.back());
  result.converged = done > 2 && !state.levels_open && state.looks > 0 &&
                     (effect < settings_.convergence || restsWithin(state, before));
  if (result.converged && settings_.pair_budget > 0 && !state.chosen_at_end) {
    state.choose_again = true;
    result.converged = false;
  }
  const BiasEvaluator correction(trajectory_, biases);
  parallelFor(matchers_.size(), settings_.threads,
              [&](std::size_t i) { matchers_[i].correct(correction); });
  shrinkThreshold(state);
}

std::vector<std::string> QuasiRigorousCalibration::observability(
    const State& state, const std::vector<std::pair<double, double>>& spans,
    const CalibrationResult& result) const {
  if (state.observationCount() == 0) return {};
  std::vector<FlownStrip> flown;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    flown.push_back({ids_[i], spans[i], map_.pointCount(static_cast<int>(i))});
  }
  ObservabilitySettings settings;
  settings.estimate = settings_.estimate;
  settings.limits = settings_.limits;
  settings.shared_errors = settings_.shared_errors;
  settings.levels = state.adjustment.levels();
  settings.threads = settings_.threads;
  settings.pairs.noise = settings_.noise;
  settings.pairs.selection = settings_.selection;
  settings.pairs.candidates = settings_.candidates;
  settings.pairs.control_sigma = settings_.control_sigma;
  for (const SystemParameterInfo& info : systemParameters()) {
    settings.reported[indexOf(info.parameter)] = result[info.parameter].std;
  }
  return describeObservability(
             observedBlock(flown, *trajectory_, state.observations, state.weights.weights()),
             settings)
      .text();
}

std::vector<std::vector<TimeSpan>> QuasiRigorousCalibration::measuredTimes() const {
  std::vector<std::vector<TimeSpan>> times(ids_.size());
  for (const AreaMatcher& matcher : matchers_) {
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const auto span = matcher.timesOf(static_cast<int>(i));
      if (span) times[i].push_back(*span);
    }
  }
  return times;
}

std::string QuasiRigorousCalibration::whyOpen(const CalibrationResult& result) const {
  return "the adjustment did not converge in " + std::to_string(result.iterations.size()) +
         " iterations" + (settings_.pair_budget > 0 ? "; let -select keep more pairs" : "");
}

CalibrationResult QuasiRigorousCalibration::calibrate() {
  prepare();
  std::vector<std::pair<double, double>> spans;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const int strip = static_cast<int>(i);
    spans.push_back(used_[i] ? std::pair(map_.startTime(strip), map_.endTime(strip))
                             : std::pair(0.0, 0.0));
  }
  const SharedErrors errors(spans, settings_.shared_errors, measuredTimes());
  State state(errors, settings_.threads);
  state.choice.solution = state.adjustment.unsolved(SystemVector::Zero());
  state.threshold = settings_.max_normal_distance;
  CalibrationResult result;
  pairUp(state);
  lookAtControl(state);
  const CalibrationReport report(ids_, !control_seen_);
  report.addFit(state.observations, SystemVector::Zero(), false, result);
  const MisfitComparison misfit(state.observations);
  const int most = (settings_.pair_budget > 0 ? 2 : 1) * settings_.max_iterations;
  for (int i = 0; i < most && !result.converged && state.observationCount() > 0; ++i) {
    iterate(state, result);
    if (!result.converged) pairUp(state);
  }
  const bool open = !result.converged;
  result.sigma0 = state.weights.sigma0();
  result.redundancy = state.redundancy();
  result.warnings = warnings_;
  result.attitude = attitude_;
  result.line_fit_half_width = trajectory_->lineFitHalfWidth();
  report.addParameters(state.choice, settings_.estimate, result);
  report.addStrips(errors, used_, state.choice.solution, result);
  if (!result.converged) weigh(state);  // the last pairs are newer than their weights
  result.observability = observability(state, spans, result);
  information_ = state.adjustment.informationShares(state.choice.estimate);
  information_.resize(areas_.size(), 0.0);
  state.threshold = settings_.max_normal_distance;
  state.seekers = AreaMatcher::Seekers::candidates;
  pairUp(state);
  report.addFit(state.observations, result.biases(), true, result);
  report.addStripFit(state.observations, state.adjustment, state.choice.solution, result);
  result.misfit = misfit.change(state.observations, result.biases());
  judgeCalibration(settings_.estimate, open ? whyOpen(result) : "", result);
  return result;
}

}  // namespace pcl_als
