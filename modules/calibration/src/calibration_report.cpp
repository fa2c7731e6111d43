// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "calibration_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <pcl_als/common/statistics.h>

#include "strip_covariance.h"

namespace pcl_als {
namespace {

PairFit& pairFit(CalibrationResult& result, const std::string& a, const std::string& b) {
  const auto same = [&](const PairFit& fit) { return fit.a == a && fit.b == b; };
  const auto found = std::find_if(result.pairs.begin(), result.pairs.end(), same);
  if (found != result.pairs.end()) return *found;
  PairFit fit;
  fit.a = a;
  fit.b = b;
  result.pairs.push_back(fit);
  return result.pairs.back();
}

ControlFit& controlFit(CalibrationResult& result, const std::string& strip) {
  const auto same = [&](const ControlFit& fit) { return fit.strip == strip; };
  const auto found = std::find_if(result.control.begin(), result.control.end(), same);
  if (found != result.control.end()) return *found;
  ControlFit fit;
  fit.strip = strip;
  result.control.push_back(fit);
  return result.control.back();
}

}  // namespace

CalibrationReport::CalibrationReport(const std::vector<std::string>& strip_ids,
                                     bool without_control)
    : ids_(strip_ids), without_control_(without_control) {}

namespace {

using FitStatistics = std::map<std::pair<int, int>, RunningStatistics>;

/// Fits by pair of strips, from the residuals of all observations. Means are heights of the first
/// strip above the second; for control, of the strip above the point.
template <typename Residual>
FitStatistics fitOf(const std::vector<AreaObservations>& observations, const Residual& residual) {
  FitStatistics statistics;
  for (const AreaObservations& area : observations) {
    for (const PairObservation& o : area) {
      const double distance = residual(o);
      if (o.isInPlan()) continue;
      if (o.a == PairObservation::kControl) {
        statistics[{o.a, o.b}].add(o.aboveControl(distance));
      } else {
        statistics[std::minmax(o.a, o.b)].add(o.sign() * distance);
      }
    }
  }
  return statistics;
}

constexpr int kHistogramBins = 200;

/// Symmetric bins that contain the distances before.
std::vector<double> histogramEdges(const std::vector<PairFit>& pairs) {
  double squares = 0.0, count = 0.0;
  for (const PairFit& pair : pairs) {
    const auto weight = static_cast<double>(pair.correspondences);
    squares += weight * pair.rms_before * pair.rms_before;
    count += weight;
  }
  const double reach = 2.5 * std::sqrt(squares / std::max(1.0, count));
  if (!(reach > 0.0)) return {};
  std::vector<double> edges;
  for (int i = 0; i <= kHistogramBins; ++i) {
    edges.push_back(reach * (2.0 * i / kHistogramBins - 1.0));
  }
  return edges;
}

template <typename Residual>
std::vector<std::size_t> histogramOf(const std::vector<AreaObservations>& observations,
                                     const std::vector<double>& edges, const Residual& residual) {
  std::vector<std::size_t> counts(edges.empty() ? 0 : kHistogramBins, 0);
  if (edges.empty()) return counts;
  const double width = (edges.back() - edges.front()) / kHistogramBins;
  for (const AreaObservations& area : observations) {
    for (const PairObservation& o : area) {
      if (o.a == PairObservation::kControl) continue;
      const double distance = o.sign() * residual(o);
      const double bin = std::floor((distance - edges.front()) / width);
      if (bin >= 0.0 && bin < kHistogramBins) ++counts[static_cast<std::size_t>(bin)];
    }
  }
  return counts;
}

}  // namespace

void CalibrationReport::addFit(const std::vector<AreaObservations>& observations,
                               const SystemVector& biases, bool after,
                               CalibrationResult& result) const {
  const auto fill = [after](const RunningStatistics& values, auto& fit) {
    (after ? fit.mean_after : fit.mean_before) = values.mean();
    (after ? fit.rms_after : fit.rms_before) = values.rms();
  };
  const auto distance = [&](const PairObservation& o) { return o.distance(biases); };
  for (const auto& [strips, values] : fitOf(observations, distance)) {
    if (strips.first == PairObservation::kControl) {
      ControlFit& fit = controlFit(result, ids_[strips.second]);
      fit.points = values.count();
      fill(values, fit);
    } else {
      PairFit& fit = pairFit(result, ids_[strips.first], ids_[strips.second]);
      fit.correspondences = values.count();
      fill(values, fit);
    }
  }
  ResidualHistogram& histogram = result.residuals;
  if (!after) histogram.edges = histogramEdges(result.pairs);
  (after ? histogram.after : histogram.before) =
      histogramOf(observations, histogram.edges, distance);
}

namespace {

/// Mean heights of strips above a control point, or distances along the normal of a patch.
ControlPointFit heightFit(const AreaObservations& area, bool patch, const SystemVector& biases,
                          double trajectory_std) {
  ControlPointFit fit;
  if (patch) fit.component = "normal";
  double variance = 0.0, shared = 0.0, count = 0.0;
  std::set<int> strips;
  for (const PairObservation& o : area) {
    if (o.isInPlan()) continue;
    strips.insert(o.b);
    fit.before += o.aboveControl(o.misclosure);
    fit.after += o.aboveControl(o.distance(biases));
    variance += o.variance;
    shared += o.variance * o.variance_inflation;
    count += 1.0;
  }
  fit.strips = strips.size();
  if (fit.strips == 0) return fit;
  fit.before /= count;
  fit.after /= count;
  // Points of a patch share its error; the strips above a point are few.
  const double of_mean = (patch ? shared / count : variance) / count;
  fit.expected_std =
      std::sqrt(of_mean + trajectory_std * trajectory_std / static_cast<double>(fit.strips));
  return fit;
}

/// The mean place of a target in the strips, to the east (0) or north (1) of the surveyed one.
ControlPointFit planFit(const AreaObservations& area, int axis, const SystemVector& biases,
                        double trajectory_std) {
  ControlPointFit fit;
  fit.component = axis == 0 ? "east" : "north";
  double variance = 0.0;
  std::set<int> strips;
  for (const PairObservation& o : area) {
    if (!o.isInPlan()) continue;
    strips.insert(o.b);
    const double part = o.normal[axis];
    fit.before += part * o.aboveControl(o.misclosure);
    fit.after += part * o.aboveControl(o.distance(biases));
    variance += part * part * o.variance * o.variance_inflation;
  }
  const auto count = static_cast<double>(strips.size());
  fit.strips = strips.size();
  if (fit.strips == 0) return fit;
  fit.before /= count;
  fit.after /= count;
  fit.expected_std =
      std::sqrt(variance / (count * count) + trajectory_std * trajectory_std / count);
  return fit;
}

}  // namespace

void CalibrationReport::addControlPoints(const std::vector<ControlPoint>& control,
                                         const std::vector<AreaObservations>& observations,
                                         const std::vector<AreaUse>& used, double trajectory_std,
                                         CalibrationResult& result) const {
  const std::size_t first = observations.size() - control.size();
  for (std::size_t i = 0; i < control.size(); ++i) {
    const ControlPoint& point = control[i];
    const AreaObservations& area = observations[first + i];
    const auto add = [&](ControlPointFit fit, double sigma, bool is_used) {
      if (fit.strips == 0) return;
      fit.id = point.id;
      fit.sigma = sigma;
      fit.used = is_used;
      result.control_points.push_back(std::move(fit));
    };
    const bool patch = point.kind == ControlPoint::Kind::patch;
    add(heightFit(area, patch, result.biases(), trajectory_std), point.sigma,
        used[first + i].heights);
    for (const int axis : {0, 1})
      add(planFit(area, axis, result.biases(), trajectory_std), point.sigmaInPlan(),
          used[first + i].plan);
  }
}

void CalibrationReport::addStrips(const SharedErrors& errors, const std::vector<bool>& used,
                                  const Adjustment& adjustment, const ParameterChoice& choice,
                                  CalibrationResult& result) const {
  const auto covariance = adjustment.stripCovariance(choice.solution);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    if (!used[i]) continue;
    const int strip = static_cast<int>(i);
    result.strip_errors.push_back({ids_[i], errors.errorsOf(strip, choice.solution.shared), {}});
    if (covariance) covariance->add(strip, choice.estimate, result.strip_errors.back());
  }
}

void CalibrationReport::addStripFit(const std::vector<AreaObservations>& observations,
                                    const Adjustment& adjustment,
                                    const AdjustmentSolution& solution,
                                    CalibrationResult& result) const {
  const auto residual = [&](const PairObservation& o) { return adjustment.residual(o, solution); };
  for (const auto& [strips, values] : fitOf(observations, residual)) {
    if (strips.first == PairObservation::kControl) continue;
    PairFit& fit = pairFit(result, ids_[strips.first], ids_[strips.second]);
    fit.mean_strips = values.mean();
    fit.rms_strips = values.rms();
  }
}

void CalibrationReport::addParameters(const ParameterChoice& choice,
                                      const std::vector<SystemParameter>& requested,
                                      CalibrationResult& result) const {
  reportParameters(choice, requested, result);
  if (without_control_)
    result.warnings.push_back(
        {"without control the absolute height of the block is not checked", Hint::control});
}

}  // namespace pcl_als
