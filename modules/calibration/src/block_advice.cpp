// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <pcl_als/calibration/block_advice.h>

#include "virtual_lines.h"

namespace pcl_als {
namespace {

using P = SystemParameter;

constexpr std::size_t kObservations = 20'000;  // of a block that is adjusted again and again
constexpr double kHelps = 0.2;                 // benefit from which on advice is worth a line
constexpr double kWorthSaying = 0.85;          // after / before from which on a change is not told
constexpr double kWellKnown = 0.01;            // metres on the ground

std::string valueOf(P p, double value) {
  const std::string text = inUnit(p, value);
  return text.substr(0, text.find(' '));
}

/// "std of boresight_pitch from 12 to 3 arcsec, lever_arm_y determined (0.008 m)"; best first.
std::string effectOf(const SystemVector& before, const SystemVector& after) {
  std::vector<std::pair<double, std::string>> effects;
  for (const SystemParameterInfo& info : systemParameters()) {
    const double from = before[indexOf(info.parameter)], to = after[indexOf(info.parameter)];
    if (std::isnan(to)) continue;
    const std::string name(info.name);
    if (std::isnan(from)) {
      effects.emplace_back(0.0, "determine " + name + " (std " + inUnit(info.parameter, to) + ")");
    } else if (to < kWorthSaying * from) {
      effects.emplace_back(to / from, "reduce the std of " + name + " from " +
                                          valueOf(info.parameter, from) + " to " +
                                          inUnit(info.parameter, to));
    }
  }
  std::sort(effects.begin(), effects.end());
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, effects.size()); ++i) {
    text += (i == 0 ? "" : ", ") + effects[i].second;
  }
  return text;
}

double benefitOf(const Advice& advice, const DeterminationLimits& limits) {
  double benefit = 0.0;
  for (const SystemParameterInfo& info : systemParameters()) {
    if (info.parameter == P::lever_arm_z) continue;
    const double worst = 10.0 * limits.of(info.parameter);
    const auto known = [&](double std) { return std::isnan(std) ? worst : std::min(std, worst); };
    benefit += std::log(known(advice.before[indexOf(info.parameter)]) /
                        known(advice.after[indexOf(info.parameter)]));
  }
  return benefit;
}

/// Adds what a piece of advice stands for to a copy of the block and adjusts it.
SystemVector deviationsWith(const Advice& advice, ObservedBlock block,
                            const ObservabilitySettings& settings) {
  const SyntheticPairs pairs(settings.pairs);
  if (advice.is_line) {
    pairs.addPairs(SyntheticPairs::addStrip(advice.line, block), block);
  } else {
    for (const Eigen::Vector2d& place : advice.control) pairs.addControl(place, block);
  }
  return AdjustedBlock(block, settings).deviations();
}

SystemVector effectOnGround(const ObservedBlock& block, const BlockFacts& facts) {
  double height = 0.0;
  for (const double h : facts.heights) height += h / static_cast<double>(facts.heights.size());
  double half_angle = facts.half_angle;
  if (height <= 0.0) {
    height = block.strips.front().height;
    half_angle = block.strips.front().half_angle;
  }
  return Observability::groundEffect(height, std::max(half_angle, 0.05));
}

}  // namespace

std::vector<P> automaticParameters(bool with_control) {
  std::vector<P> parameters;
  for (const SystemParameterInfo& info : systemParameters()) {
    if (info.parameter == P::lever_arm_z) continue;
    if (info.parameter == P::range_bias && !with_control) continue;
    parameters.push_back(info.parameter);
  }
  return parameters;
}

AdjustedBlock::AdjustedBlock(const ObservedBlock& block, const ObservabilitySettings& settings)
    : errors_(block.spans, settings.shared_errors), adjustment_(errors_, settings.threads) {
  adjustment_.setLevels(settings.levels);
  adjustment_.accumulate(block.observations, block.weights);
  // What was asked for by name is dropped only when it is hopeless, as in the calibration.
  const double factor = settings.estimate.empty() ? 1.0 : 10.0;
  choice_ = chooseParameters(
      adjustment_,
      settings.estimate.empty() ? automaticParameters(block.control_points > 0) : settings.estimate,
      SystemVector::Zero(), settings.limits, factor);
}

SystemVector AdjustedBlock::deviations() const {
  SystemVector std = SystemVector::Constant(std::numeric_limits<double>::quiet_NaN());
  for (const P p : choice_.estimate) {
    std[indexOf(p)] = std::sqrt(choice_.solution.covariance(indexOf(p), indexOf(p)));
  }
  return std;
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
  for (const ParameterDirection& one : directions) {
    if (one.std > kWellKnown) lines.push_back("direction: " + one.text);
  }
  for (const Advice& one : advice) lines.push_back("advice: " + one.text);
  return lines;
}

ObservabilityReport describeObservability(const ObservedBlock& whole,
                                          const ObservabilitySettings& given) {
  const ObservedBlock block = whole.thinned(kObservations);
  const BlockFacts facts(block);
  ObservabilitySettings settings = given;
  if (!settings.planned) settings.pairs.surface = surfaceOf(facts);
  const AdjustedBlock now(block, settings);
  const SystemVector own = now.deviations();
  SystemVector factor = SystemVector::Ones();
  for (int i = 0; i < kSystemParameterCount; ++i) {
    if (own[i] > 0.0 && settings.reported[i] > own[i]) factor[i] = settings.reported[i] / own[i];
  }
  ObservabilityReport report;
  report.facts = facts.text();
  std::vector<P> wanted = settings.estimate.empty() ? automaticParameters(true) : settings.estimate;
  Observability observability(now.adjustment().reducedNormal(), wanted,
                              effectOnGround(block, facts));
  observability.weaken(factor);
  report.directions = observability.directions();
  report.weak = observability.combinations(facts, settings.limits);
  if (!settings.advise) return report;
  for (Advice& advice : virtualAdditions(block)) {
    advice.before = own.cwiseProduct(factor);
    advice.after = deviationsWith(advice, block, settings).cwiseProduct(factor);
    advice.benefit = benefitOf(advice, settings.limits);
    const std::string effect = effectOf(advice.before, advice.after);
    advice.text = advice.what + " would " + effect;
    if (advice.benefit > kHelps && !effect.empty()) report.advice.push_back(std::move(advice));
  }
  std::stable_sort(report.advice.begin(), report.advice.end(),
                   [](const Advice& a, const Advice& b) { return a.benefit > b.benefit; });
  return report;
}

StripGeometry flownStrip(const std::string& id, int index, const std::pair<double, double>& span,
                         const Trajectory& trajectory,
                         const std::vector<AreaObservations>& observations) {
  StripGeometry strip;
  strip.id = id;
  strip.first_time = span.first;
  SensorPose pose;
  std::size_t cursor = 0;
  if (trajectory.poseAt(span.first, pose, cursor)) strip.start = pose.position.head<2>();
  if (trajectory.poseAt(span.second, pose, cursor)) strip.end = pose.position.head<2>();
  const double duration = span.second - span.first;
  if (duration > 0.0 && strip.length() > 0.0) strip.speed = strip.length() / duration;
  std::vector<double> heights;
  double widest = 0.0;
  for (const AreaObservations& area : observations) {
    for (const PairObservation& o : area) {
      if (o.b != index) continue;  // lateral and height are the patch's
      heights.push_back(o.height);
      widest = std::max(widest, std::atan2(o.lateral, o.height));
    }
  }
  if (heights.empty()) return strip;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  strip.height = *middle;
  strip.half_angle = std::max(widest, 0.01);
  return strip;
}

}  // namespace pcl_als
