// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Offsets of the coordinates of the whole block from control or from surfaces that are held fixed.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/statistics.h>

#include "block_diagnosis.h"
#include "block_estimate.h"
#include "error_diagnosis.h"
#include "system_groups.h"

namespace pcl_als {
namespace {

// metres: checkControl() refuses control that lies farther from the strips
constexpr double kFarthestControl = 10.0;
// metres: range biases and lever arm errors of mounted systems are smaller
constexpr double kLargestOfSystem = 0.5;
// times the noise of ranges: distortion of a swath by a range bias in place of an offset, from
// which on pairs would be rejected
constexpr double kNoticeable = 1.5;
constexpr std::size_t kFewestHeights = 3;  // that show a height in common
constexpr double kSpread = 0.25;           // of the height in common, robust standard deviation
constexpr double kDiffersFromZero = 2.0;   // standard deviations

/// "0.300 +- 0.011 m"
std::string sizeText(double value, double std) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3f +- %.3f m", std::abs(value), std);
  return text;
}

/// Effect of the parameters on heights below the sensor, for a value of one.
SystemVector onHeight() {
  SystemVector effect = SystemVector::Zero();
  effect[indexOf(SystemParameter::lever_arm_z)] = 1.0;
  effect[indexOf(SystemParameter::range_bias)] = -1.0;
  return effect;
}

/// Heights of the strips, as delivered, above control points; above surfaces that are held fixed
/// where there is no control.
std::vector<double> heightsAboveKnown(const AreaSample& sample, const PairSet& pairs) {
  const SurveyBlock& block = sample.block();
  const auto found = sample.collect<double>([&](std::size_t i, std::vector<double>& heights) {
    if (block.isControl(i)) {
      if (block.controlOf(i).kind == ControlPoint::Kind::target) return;
      for (const PairObservation& o : matchControl(sample, i, kFarthestControl))
        heights.push_back(o.aboveControl(o.misclosure));
      return;
    }
    for (const PairObservation& o : pairs.observations[i])
      if (block.strips.isFixed(o))
        heights.push_back((block.strips.isFixed(o.b) ? 1.0 : -1.0) * o.misclosure / o.normal.z());
  });
  const auto first = found.begin() + static_cast<std::ptrdiff_t>(block.pairAreas());
  const bool control = std::any_of(first, found.end(), [](const auto& v) { return !v.empty(); });
  std::vector<double> heights;
  for (auto area = control ? first : found.begin(); area != found.end(); ++area)
    heights.insert(heights.end(), area->begin(), area->end());
  return heights;
}

}  // namespace

double startingOffset(const AreaSample& sample, const PairSet& pairs) {
  std::vector<double> heights = heightsAboveKnown(sample, pairs);
  if (heights.size() < kFewestHeights) return 0.0;
  const double common = medianInPlace(heights);
  for (double& height : heights) height = std::abs(height - common);
  const double spread = 1.4826 * medianInPlace(heights);
  const double distortion = std::abs(common) * (1.0 - std::cos(swathEdge(pairs.observations).beta));
  const bool is_large = std::abs(common) > kLargestOfSystem ||
                        distortion > kNoticeable * sample.block().settings().noise.range;
  return is_large && spread <= kSpread * std::abs(common) ? common : 0.0;
}

void judgeBlockOffset(const BlockEstimate& estimated, CalibrationResult& result) {
  constexpr int kHeight = indexOf(ErrorSource::height_offset);
  const AdjustmentSolution& diagnosed = estimated.diagnosed;
  const ParameterChoice& choice = estimated.solution.choice;
  if (!estimated.scale.to_control || !diagnosed.solved || !choice.solution.solved ||
      result.sources[kHeight] != 0.0)
    return;
  // What the parameters would be if the block had the offset as well.
  const SystemVector change =
      estimated.solution.adjustment.derivativeBySource(ErrorSource::height_offset, choice.estimate);
  const double offset = diagnosed.source_value[kHeight], offset_std = diagnosed.source_std[kHeight];
  std::vector<SystemParameter> inseparable;
  std::string names;
  for (const SystemParameter p : choice.estimate) {
    const ParameterEstimate& estimate = result[p];
    const double moved = std::abs(change[indexOf(p)]) * offset_std;
    const double other = estimate.bias + change[indexOf(p)] * offset;
    if (std::abs(estimate.bias) < kDiffersFromZero * estimate.std || moved < estimate.std ||
        std::abs(other) > kDiffersFromZero * std::hypot(estimate.std, moved))
      continue;
    inseparable.push_back(p);
    names += (names.empty() ? "" : ", ") + std::string(infoOf(p).name);
  }
  const SystemVector on_height = onHeight();
  if (std::none_of(inseparable.begin(), inseparable.end(),
                   [&](SystemParameter p) { return on_height[indexOf(p)] != 0.0; }))
    return;
  const SystemMatrix& covariance = choice.solution.covariance;
  const double sum = on_height.dot(result.biases());
  const std::string reason =
      "the data cannot tell it from a height offset of the block (antenna height, geoid, datum); "
      "only their sum is determined, by which the points are " +
      sizeText(sum, std::sqrt(on_height.dot(covariance * on_height))) +
      (sum < 0.0 ? " too low" : " too high");
  for (const SystemParameter p : inseparable) {
    result[p].determined = false;
    result[p].reason = reason;
  }
  for (ErrorFinding& finding : result.diagnosis) {
    const bool one = std::any_of(inseparable.begin(), inseparable.end(), [&](SystemParameter p) {
      return finding.source == infoOf(p).name;
    });
    if (one) finding.determined = false, finding.evidence = reason;
    if (finding.source == infoOf(ErrorSource::height_offset).name)
      finding.evidence = "the data cannot tell it from " + names;
  }
  result.warnings.push_back("not determined one by one: " + names + ": " + reason +
                            "; the correction of points is the same for either");
}

void warnOfBlockOffset(CalibrationResult& result) {
  static constexpr std::pair<ErrorSource, std::pair<const char*, const char*>> kOffsets[] = {
      {ErrorSource::height_offset, {"above", "below"}},
      {ErrorSource::east_offset, {"east of", "west of"}},
      {ErrorSource::north_offset, {"north of", "south of"}}};
  const auto points =
      std::count_if(result.control_points.begin(), result.control_points.end(),
                    [](const ControlPointFit& point) { return point.used && !point.isInPlan(); });
  const std::string known =
      points > 0 ? std::to_string(points) + " control points" : "the surfaces that are held fixed";
  for (const auto& [source, sides] : kOffsets) {
    const double value = result.sources[indexOf(source)];
    if (value == 0.0) continue;
    for (const ErrorFinding& finding : result.diagnosis) {
      if (finding.source != infoOf(source).name) continue;
      result.warnings.push_back("the strips lie " + sizeText(value, finding.std) + " " +
                                (value > 0.0 ? sides.first : sides.second) + " " + known + " (" +
                                finding.source + "): " + finding.hint +
                                "; the correction of points and of the trajectory removes it");
    }
  }
}

}  // namespace pcl_als
