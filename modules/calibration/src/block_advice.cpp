// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "block_advice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/common/text_values.h>

#include "virtual_lines.h"

namespace pcl_als {
namespace {

using P = SystemParameter;

// observations of a block that is adjusted repeatedly
constexpr double kLeastBenefit = 0.1;     // least benefit of advice
constexpr double kReportedRatio = 0.85;   // after / before above which a change is not reported
constexpr std::size_t kAdviceInText = 6;  // entries in the text; the report contains all
constexpr std::size_t kDirectionsInText = 2;
constexpr double kAccurate = 0.01;  // metres on the ground: needs no improvement

/// "reduce the std of boresight_pitch from 12 to 3 arcsec, determine …"; best first.
std::string effectOf(const SystemVector& before, const SystemVector& after,
                     const BlockAdjustment& now, const BlockAdjustment& then) {
  std::vector<std::pair<double, std::string>> effects;
  for (const SystemParameterInfo& info : systemParameters()) {
    const P p = info.parameter;
    const double from = before[indexOf(p)], to = after[indexOf(p)];
    if (to >= kReportedRatio * from || !std::isfinite(to)) continue;
    const std::string name(info.name);
    if (then.determines(p) && !now.determines(p)) {
      effects.emplace_back(0.0, "determine " + name + " (std " + inUnit(p, to) + ")");
    } else if (!std::isfinite(from)) {
      effects.emplace_back(1.0, "show " + name + " (std " + inUnit(p, to) + "), not yet enough");
    } else {
      effects.emplace_back(to / from, "reduce the std of " + name +
                                          (then.determines(p) ? "" : ", still not determined,") +
                                          " from " + shortValue(p, from) + " to " + inUnit(p, to));
    }
  }
  std::sort(effects.begin(), effects.end());
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, effects.size()); ++i) {
    text += (i == 0 ? "" : ", ") + effects[i].second;
  }
  return text;
}

double benefitOf(const SystemVector& before, const SystemVector& after) {
  double benefit = 0.0;
  for (int i = 0; i < kSystemParameterCount; ++i) {
    if (before[i] > 0.0 && after[i] > 0.0) benefit += std::log(before[i] / after[i]);
  }
  return benefit;
}

/// A copy of the block with a virtual line or control.
ObservedBlock with(const Advice& advice, ObservedBlock block, const SyntheticPairs& pairs) {
  if (advice.is_line) {
    pairs.addPairs(SyntheticPairs::addStrip(advice.line, block), block);
  } else {
    for (const Eigen::Vector2d& place : advice.control) pairs.addControl(place, block);
  }
  return block;
}

/// Metres on the ground at the mean height of the block and the largest angle of its pairs.
SystemVector groundEffect(const ObservedBlock& block, const BlockFacts& facts) {
  if (facts.heights.empty()) {
    const StripGeometry& any = block.strips.front();
    return Observability::groundEffect(any.height, any.half_angle);
  }
  // radians: at smaller angles the scale of the scan angle has no effect
  constexpr double kLeastAngle = 0.05;
  const double sum = std::accumulate(facts.heights.begin(), facts.heights.end(), 0.0);
  return Observability::groundEffect(sum / static_cast<double>(facts.heights.size()),
                                     std::max(facts.half_angle, kLeastAngle));
}

}  // namespace

namespace {

/// Standard deviation of a point below the sensor by the errors of the trajectory, metres.
double trajectoryEffect(const SharedErrorModel& model, const VarianceFactors& levels,
                        const BlockFacts& facts) {
  const auto scale = [&](double VarianceFactors::Trajectory::*level) {
    return model.constant_share * levels.constant.*level +
           model.smooth_share * levels.smooth.*level +
           (1.0 - model.constant_share - model.smooth_share) * levels.gauss_markov.*level;
  };
  const double height = facts.heights.empty() ? 0.0 : facts.heights.back();
  return std::sqrt(model.position * model.position * scale(&VarianceFactors::Trajectory::position) +
                   std::pow(height * model.roll_pitch, 2) *
                       scale(&VarianceFactors::Trajectory::roll_pitch));
}

}  // namespace

BlockAdjustment::BlockAdjustment(const ObservedBlock& block, const ObservabilitySettings& settings)
    : errors_(block.spans, settings.shared_errors,
              observedTimes(block.observations, block.spans.size())),
      adjustment_(errors_, settings.threads) {
  adjustment_.setVarianceFactors(settings.levels);
  adjustment_.accumulate(block.observations, block.weights);
  const bool automatic = settings.estimate.empty();
  wanted_ = automatic ? automaticParameters(true, settings.shared_errors) : settings.estimate;
  // Parameters requested by name are excluded at three times their limit only, as in the
  // calibration.
  const double factor = automatic ? 1.0 : 10.0;
  choice_ = chooseParameters(
      adjustment_,
      automatic ? automaticParameters(block.control_points > 0, settings.shared_errors) : wanted_,
      SystemVector::Zero(), settings.limits, factor);
  const Observability observability(adjustment_.normalOf(wanted_), wanted_,
                                    groundEffect(block, BlockFacts(block)));
  SystemVector prior;
  for (const SystemParameterInfo& info : systemParameters()) {
    prior[indexOf(info.parameter)] = 2.0 * factor * settings.limits.of(info.parameter);
  }
  deviations_ = observability.deviations(prior);
  alone_ =
      observability.deviations(SystemVector::Constant(std::numeric_limits<double>::infinity()));
  // hardly observable from strips alone: no line helps
  if (automatic && block.control_points == 0 && !settings.shared_errors.biases.of(P::range_bias)) {
    deviations_[indexOf(P::range_bias)] = prior[indexOf(P::range_bias)];
    alone_[indexOf(P::range_bias)] = std::numeric_limits<double>::infinity();
  }
}

SystemVector BlockAdjustment::expected() const {
  SystemVector std = alone_;
  for (const P p : choice_.estimate) std[indexOf(p)] = deviations_[indexOf(p)];
  return std;
}

bool BlockAdjustment::determines(P p) const {
  return choice_.status[indexOf(p)] == ParameterStatus::estimated;
}

const Advice* ObservabilityReport::cheapestLine() const {
  const Advice* best = nullptr;
  for (const Advice& one : advice) {
    if (!one.is_line) continue;
    if (best == nullptr || one.benefit / one.duration() > best->benefit / best->duration()) {
      best = &one;
    }
  }
  return best;
}

std::vector<std::string> ObservabilityReport::text() const {
  std::vector<std::string> lines{"the block: " + facts};
  for (const WeakCombination& one : weak) lines.push_back("weak: " + one.text);
  std::size_t told = 0;
  for (const ParameterDirection& one : directions) {
    if (one.std > std::max(kAccurate, other_errors) && told++ < kDirectionsInText)
      lines.push_back("weakly determined: " + one.text);
  }
  for (std::size_t i = 0; i < std::min(kAdviceInText, advice.size()); ++i) {
    lines.push_back("advice: " + advice[i].text);
  }
  return lines;
}

namespace {

/// Sets before, after, benefit and text of all virtual lines and control; keeps the beneficial
/// ones.
std::vector<Advice> adviceFor(const ObservedBlock& block, const BlockAdjustment& now,
                              const SystemVector& factor, const ObservabilitySettings& settings) {
  const SyntheticPairs pairs(settings.pairs);
  std::vector<Advice> additions = virtualAdditions(block);
  std::vector<char> helps(additions.size());
  parallelFor(additions.size(), settings.threads, [&](std::size_t i) {
    Advice& advice = additions[i];
    const BlockAdjustment then(with(advice, block, pairs), settings);
    advice.before = now.expected().cwiseProduct(factor);
    advice.after = then.expected().cwiseProduct(factor);
    advice.benefit = benefitOf(now.deviations(), then.deviations());
    const std::string effect = effectOf(advice.before, advice.after, now, then);
    advice.text = advice.what + " would " + effect;
    helps[i] = advice.benefit > kLeastBenefit && !effect.empty() ? 1 : 0;
  });
  std::vector<Advice> helpful;
  for (std::size_t i = 0; i < additions.size(); ++i)
    if (helps[i] != 0) helpful.push_back(std::move(additions[i]));
  std::stable_sort(helpful.begin(), helpful.end(),
                   [](const Advice& a, const Advice& b) { return a.benefit > b.benefit; });
  return helpful;
}

}  // namespace

ObservabilityReport describeObservability(const ObservedBlock& block,
                                          const ObservabilitySettings& given) {
  const BlockFacts facts(block);
  ObservabilitySettings settings = given;
  if (!settings.planned) settings.pairs.surface = surfaceOf(facts);
  const BlockAdjustment now(block, settings);
  SystemVector factor = SystemVector::Ones();
  for (int i = 0; i < kSystemParameterCount; ++i) {
    const double own = now.deviations()[i];
    if (own > 0.0 && settings.reported[i] > own) factor[i] = settings.reported[i] / own;
  }
  Observability observability(now.adjustment().normalOf(now.wanted()), now.wanted(),
                              groundEffect(block, facts));
  observability.weaken(factor);
  ObservabilityReport report;
  report.facts = facts.text();
  report.other_errors = trajectoryEffect(settings.shared_errors, settings.levels, facts);
  report.directions = observability.directions();
  report.weak = observability.combinations(facts, settings.limits);
  if (settings.advise) report.advice = adviceFor(block, now, factor, settings);
  return report;
}

namespace {

/// A flown strip as a straight line; without a length where it has no pairs.
StripGeometry straight(const StripTrajectory& flown, const Trajectory& trajectory) {
  StripGeometry strip;
  strip.id = flown.id;
  strip.first_time = flown.span.first;
  const bool paired = flown.height > 0.0;
  if (paired) {
    constexpr double kLeastAngle = 0.01;  // radians
    strip.height = flown.height;
    strip.half_angle = std::max(kLeastAngle, flown.half_angle);
  }
  const double duration = flown.span.second - flown.span.first;
  SensorPose first, last;
  std::size_t cursor = 0;
  if (!paired || !(duration > 0.0) || !trajectory.poseAt(flown.span.first, first, cursor) ||
      !trajectory.poseAt(flown.span.second, last, cursor)) {
    return strip;
  }
  strip.start = first.position.head<2>();
  strip.end = last.position.head<2>();
  strip.speed = std::max(1.0, strip.length() / duration);
  const double ground = 2.0 * strip.halfSwath() * strip.length();
  if (ground > 0.0 && flown.points > 0) {
    strip.density = static_cast<double>(flown.points) / ground;
  }
  return strip;
}

}  // namespace

ObservedBlock observedBlock(const AdjustedSurvey& survey, const Trajectory& trajectory) {
  ObservedBlock block;
  for (const StripTrajectory& strip : survey.strips) {
    block.spans.push_back(strip.span);
    block.strips.push_back(straight(strip, trajectory));
  }
  for (const AreaObservations& area : survey.sample.observations) {
    const bool control = !area.empty() && area.front().a == PairObservation::kControl;
    if (control) ++block.control_points;
  }
  block.observations = survey.sample.observations;
  block.weights = survey.sample.weights;
  return block;
}

namespace {

/// What the strips of a calibration are compared with besides each other.
std::string controlText(const CalibrationResult& result) {
  std::size_t points = 0, patches = 0, surfaces = 0, strips = 0;
  std::set<std::string> targets;  // with their heights, which are no other control points
  for (const ControlPointFit& fit : result.control_points)
    if (fit.isInPlan()) targets.insert(fit.id);
  for (const ControlPointFit& fit : result.control_points)
    if (targets.count(fit.id) == 0) ++(fit.component == "normal" ? patches : points);
  for (const FixedSurface& surface : result.held) {
    strips += surface.strips.size();
    if (surface.strips.empty()) ++surfaces;
  }
  std::vector<std::string> kinds;
  if (points > 0) kinds.push_back(counted(points, "control point"));
  if (patches > 0)
    kinds.push_back(std::to_string(patches) + " planar patch" + (patches > 1 ? "es" : ""));
  if (!targets.empty()) kinds.push_back(counted(targets.size(), "target"));
  if (surfaces > 0) kinds.push_back(counted(surfaces, "reference surface"));
  if (strips > 0) kinds.push_back(counted(strips, "fixed strip"));
  return joined(kinds);
}

}  // namespace

std::vector<std::string> describeObservability(const SurveyBlock& calibrated,
                                               const BlockCalibration& calibration) {
  const CalibrationResult& result = calibration.result;
  ObservedBlock block = observedBlock(calibration.adjusted, calibrated.trajectory());
  block.control_text = controlText(result);
  if (block.observationCount() == 0) return {};
  const CalibrationSettings& given = calibrated.settings();
  ObservabilitySettings settings;
  settings.estimate = given.estimate;
  settings.limits = given.limits;
  settings.shared_errors = given.shared_errors;
  settings.shared_errors.biases = result.prior;  // without what was not used
  settings.levels = calibration.adjusted.levels;
  settings.threads = given.threads;
  settings.pairs.noise = given.noise;
  settings.pairs.selection = given.selection;
  settings.pairs.candidates = given.candidates;
  settings.pairs.control_sigma = given.control_sigma;
  for (const SystemParameterInfo& info : systemParameters()) {
    settings.reported[indexOf(info.parameter)] = result[info.parameter].std;
  }
  return describeObservability(block, settings).text();
}

}  // namespace pcl_als
