// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "error_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "spike_and_slab.h"

namespace pcl_als {

double slabOf(SystemParameter p) {
  constexpr double kLever = 0.1, kRange = 0.1, kScale = 5e-4;
  constexpr double kAngle = 100.0 * kRadiansPerArcsec;
  switch (p) {
    case SystemParameter::lever_arm_x:
    case SystemParameter::lever_arm_y:
    case SystemParameter::lever_arm_z:
      return kLever;
    case SystemParameter::range_bias:
      return kRange;
    case SystemParameter::scan_angle_scale:
      return kScale;
    default:
      return kAngle;
  }
}

std::string evidenceOf(const ErrorFinding& finding) {
  char text[160];
  if (!finding.determined) {
    std::snprintf(text, sizeof text,
                  "the data cannot tell it from other errors: standard deviation %.3g %s",
                  finding.std, finding.unit.c_str());
    return text;
  }
  const double deviations = finding.std > 0.0 ? std::abs(finding.value) / finding.std : 0.0;
  std::snprintf(text, sizeof text, "%.1f standard deviations from zero", deviations);
  return text;
}

namespace {

bool isDetermined(ErrorSource source, const AdjustmentSolution& solution,
                  const SharedErrorModel& model) {
  const int i = indexOf(source);
  return SharedErrorModel::isDetermined(solution.source_value[i], solution.source_std[i],
                                        model.sources[static_cast<std::size_t>(i)].std);
}

/// Movement of a point at the edge of the swath by one internal unit of a source, metres.
double effectOf(ErrorSource source, const ScanGeometry& edge, double speed) {
  constexpr double kDivergence = 3e-4;       // radians
  constexpr double kIntensities = 2.302585;  // a target of a tenth of the reflectance
  const double range = edge.range();
  switch (source) {
    case ErrorSource::slope_ranging:
      return range * kDivergence;  // on a slope of 45 degrees
    case ErrorSource::time_offset:
      return speed;
    case ErrorSource::intensity_ranging:
      return kIntensities;
    case ErrorSource::deflection_scale:
      return range * std::abs(edge.beta);
    case ErrorSource::height_offset:
    case ErrorSource::east_offset:
    case ErrorSource::north_offset:
      return 1.0;
    default:
      return range;
  }
}

ErrorFinding findingOf(SystemParameter p, const ParameterEstimate& estimate,
                       const ScanGeometry& edge) {
  constexpr double kAbsent = 0.5;
  const SystemParameterInfo& info = infoOf(p);
  const double slab = slabOf(p) * slabOf(p), variance = estimate.std * estimate.std;
  // The estimate has no prior: with the slab its precision is the sum of both.
  const double posterior = 1.0 / (1.0 / slab + 1.0 / variance);
  const SpikeAndSlab mixture({{kAbsent, 0.0, slab}},
                             Eigen::VectorXd::Constant(1, posterior * estimate.bias / variance),
                             Eigen::MatrixXd::Constant(1, 1, posterior));
  ErrorFinding finding;
  finding.source = finding.title = info.name;
  std::replace(finding.title.begin(), finding.title.end(), '_', ' ');
  finding.unit = info.unit;
  finding.probability = mixture.presence()[0];
  finding.value = estimate.bias / info.internal_per_unit;
  finding.std = estimate.std / info.internal_per_unit;
  finding.effect = (designBlock(edge).col(indexOf(p)) * estimate.bias).norm();
  finding.determined = finding.corrected = true;
  finding.hint = "apply this calibration";
  finding.evidence = evidenceOf(finding);
  return finding;
}

ErrorFinding findingOf(ErrorSource source, const AdjustmentSolution& solution,
                       const SharedErrorModel& model, double unit_effect) {
  const ErrorSourceInfo& info = infoOf(source);
  const int i = indexOf(source);
  ErrorFinding finding;
  finding.source = info.name;
  finding.title = info.title;
  finding.unit = info.unit;
  finding.probability = solution.source_probability[i];
  finding.value = solution.source_value[i] / info.internal_per_unit;
  finding.std = solution.source_std[i] / info.internal_per_unit;
  finding.effect = std::abs(solution.source_value[i]) * unit_effect;
  finding.determined = isDetermined(source, solution, model);
  finding.hint = info.hint;
  finding.evidence = evidenceOf(finding);
  return finding;
}

}  // namespace

ScanGeometry swathEdge(const std::vector<AreaObservations>& observations) {
  ScanGeometry edge;
  for (const AreaObservations& area : observations) {
    for (const PairObservation& o : area) {
      edge.x = std::max<double>(edge.x, o.lateral);
      edge.z = std::min<double>(edge.z, -o.height);
    }
  }
  edge.beta = -std::atan2(edge.x, -edge.z);
  return edge;
}

bool isCorrected(ErrorSource source, const AdjustmentSolution& diagnosed,
                 const SharedErrorModel& model) {
  const int i = indexOf(source);
  // A height offset with which a range bias is zero, and a range bias without one, are hypotheses
  // of equal rank: the more probable one is estimated.
  constexpr double kMoreProbable = 0.5;
  const double supported = source == ErrorSource::height_offset ? kMoreProbable : kSupported;
  return source != ErrorSource::slope_ranging && diagnosed.source_probability[i] > supported &&
         isDetermined(source, diagnosed, model);
}

bool isPossible(ErrorSource source, const AdjustmentSolution& diagnosed,
                const SharedErrorModel& model) {
  const int i = indexOf(source);
  constexpr double kPositiveEvidence = 3.0;
  const double absent = model.sources[static_cast<std::size_t>(i)].absent;
  const double after = diagnosed.source_probability[i];
  return after * absent > kPositiveEvidence * (1.0 - after) * (1.0 - absent) &&
         isDetermined(source, diagnosed, model);
}

void addErrorSources(const SharedErrors& errors, const ParameterChoice& choice,
                     const AdjustmentSolution& diagnosed, const ScanGeometry& edge,
                     const ErrorSourceScale& scale, double speed, CalibrationResult& result) {
  result.source_scale = scale;
  if (!choice.solution.solved || !diagnosed.solved) return;
  for (const SystemParameter p : choice.estimate)
    result.diagnosis.push_back(findingOf(p, result[p], edge));
  for (const ErrorSourceInfo& info : errorSources()) {
    if (!scale.concerns(info.source)) continue;
    const int i = indexOf(info.source);
    ErrorFinding finding =
        findingOf(info.source, diagnosed, errors.model(), effectOf(info.source, edge, speed));
    finding.corrected =
        info.source != ErrorSource::slope_ranging && errors.isConsidered(info.source);
    if (finding.corrected)
      result.sources[i] = choice.solution.shared[errors.sourceUnknown(info.source)];
    result.diagnosis.push_back(std::move(finding));
  }
}

void stateReferenceIntensity(CalibrationResult& result) {
  ParameterEstimate& range = result[SystemParameter::range_bias];
  if (result.sources[indexOf(ErrorSource::intensity_ranging)] == 0.0 ||
      range.status != ParameterStatus::estimated)
    return;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "at an intensity of %.4g, the median of the block; the correction of points depends "
      "on their intensity",
      result.source_scale.median_intensity);
  range.reason += (range.reason.empty() ? "" : "; ") + std::string(text);
}

void addHeldSources(const ErrorSourceVector& values, CalibrationResult& result) {
  for (ErrorFinding& finding : result.diagnosis) {
    for (const ErrorSourceInfo& info : errorSources()) {
      const int i = indexOf(info.source);
      if (finding.source != info.name || values[i] == 0.0) continue;
      finding.corrected = true;
      result.sources[i] = values[i];
    }
  }
}

void addSourceEffects(const ErrorSourceVector& values, AreaObservations& observations) {
  if (values.isZero(0.0)) return;
  for (PairObservation& o : observations)
    o.other_effects += static_cast<float>(o.effectOfSources(values));
}

void removeSources(const ErrorSourceVector& values, AreaObservations& observations) {
  if (values.isZero(0.0)) return;
  for (PairObservation& o : observations) o.misclosure -= o.effectOfSources(values);
}

}  // namespace pcl_als
