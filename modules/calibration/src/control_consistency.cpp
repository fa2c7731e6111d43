// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "control_consistency.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <pcl_als/common/listed_names.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als {
namespace {

constexpr std::size_t kMinimumPointsForScatter = 6;  // points for an estimate of the scatter
// Expected standard deviations; six points exceed 2.43 once in a thousand normal samples.
constexpr double kScatter = 2.5;
constexpr double kMostRejected = 0.5;  // share of the points: the others are outliers

std::string inMetres(double value, const char* format = "%+.3f m") {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

ControlConsistency::ControlConsistency(const std::vector<ControlPointFit>& points) {
  std::vector<double> standardised, expected, plan;
  RunningStatistics residuals, in_plan;
  std::vector<std::pair<std::string, double>> heights;  // all but positions of targets in plan
  for (const ControlPointFit& point : points) {
    if (point.isInPlan()) {
      plan.push_back(point.after / point.expected_std);
      if (point.used) in_plan.add(point.after);
      continue;
    }
    heights.emplace_back(point.id, point.after);
    expected.push_back(point.expected_std);
    if (point.expected_std > 0.0) standardised.push_back(point.after / point.expected_std);
    if (point.used) residuals.add(point.after);
  }
  rms = residuals.rms();
  if (standardised.size() >= kMinimumPointsForScatter) scatter = robustSigma(standardised);
  plan_rms = in_plan.rms();
  if (plan.size() >= kMinimumPointsForScatter) plan_scatter = robustSigma(plan);
  groups = controlGroups(std::move(heights), medianInPlace(expected));
}

SystemVector controlSpread(const ControlConsistency& control,
                           const ControlledAdjustment& adjustment) {
  SystemVector spread = SystemVector::Zero();
  if (!control.groups) return spread;
  const auto solution = [&](const std::vector<std::string>& group, double shift) {
    std::vector<AreaObservations> moved = adjustment.observations;
    for (std::size_t i = 0; i < adjustment.control.size(); ++i) {
      if (std::find(group.begin(), group.end(), adjustment.control[i]) == group.end()) continue;
      for (PairObservation& o : moved[adjustment.first_control + i]) {
        if (!o.isInPlan()) o.misclosure += shift * o.effectOfControl();
      }
    }
    Adjustment solver(adjustment.errors, adjustment.threads);
    solver.setVarianceFactors(adjustment.levels);
    solver.accumulate(moved, adjustment.weights);
    return solver.solve(adjustment.estimate, SystemVector::Zero()).biases;
  };
  const SystemVector as_given = solution({}, 0.0);
  // The misclosure of control is control minus strip.
  const SystemVector lower_right = solution(control.groups->higher, control.groups->separation);
  const SystemVector higher_right = solution(control.groups->lower, -control.groups->separation);
  return (lower_right - as_given).cwiseAbs().cwiseMax((higher_right - as_given).cwiseAbs());
}

namespace {

constexpr double kNoChange = 0.2;  // standard deviations: adds 2 % to a standard deviation

/// The parameters whose standard deviation includes both groups.
std::string enlarge(const SystemVector& spread, CalibrationResult& result) {
  std::string names;
  for (const SystemParameterInfo& info : systemParameters()) {
    ParameterEstimate& p = result[info.parameter];
    const double change = spread[indexOf(info.parameter)];
    if (p.status != ParameterStatus::estimated || !(change > kNoChange * p.std)) continue;
    p.std = std::hypot(p.std, change);
    p.reason = "depends on which of two contradicting groups of control points is right";
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  }
  return names;
}

/// Control that scatters more than its accuracy explains. \param fits "control fits" or what of it
/// does; \param stated "its" or "their"; \param hint what to check and to state
Warning scatterWarning(const std::string& fits, double rms, double scatter,
                       const std::string& stated, const std::string& hint) {
  char times[32];
  std::snprintf(times, sizeof times, "%.1f", scatter);
  return {fits + " with an RMS of " + inMetres(rms, "%.3f m") + ", " + times + " times what " +
              stated + " stated standard deviations and those of the points and the trajectory " +
              "explain: " + hint,
          Hint::control_sigma};
}

void warnOfRejected(CalibrationResult& result) {
  std::vector<std::string> rejected, displaced;
  for (const ControlPointFit& point : result.control_points) {
    if (point.used) continue;
    std::vector<std::string>& list = point.isInPlan() ? displaced : rejected;
    const std::string direction = point.isInPlan() ? " " + point.component : "";
    list.push_back(point.id + direction + " (" + inMetres(point.after) + ")");
  }
  if (!rejected.empty()) {
    result.warnings.push_back(
        "control points rejected as outliers, with the height of the strips above (+) or below (-) "
        "them: " +
        listedNames(rejected));
  }
  if (!displaced.empty()) {
    result.warnings.push_back("targets rejected in plan as outliers, displaced in the strips by: " +
                              listedNames(displaced));
  }
}

/// Control of which most points are rejected: it is not the points that are wrong.
void objectToRejection(CalibrationResult& result) {
  std::vector<double> heights;
  double all = 0.0;
  for (const ControlPointFit& point : result.control_points) {
    if (point.isInPlan()) continue;
    all += 1.0;
    if (!point.used) heights.push_back(point.after);
  }
  const std::size_t rejected = heights.size();
  if (rejected < 2 || !(static_cast<double>(rejected) > kMostRejected * all)) return;
  const double median = medianInPlace(heights);
  result.verdict.downgrade(
      CalibrationStatus::parameters_affected,
      "control contradicts the strips: they lie " + inMetres(std::abs(median), "%.3f m") +
          (median > 0.0 ? " above " : " below ") + std::to_string(rejected) + " of " +
          std::to_string(static_cast<std::size_t>(all)) +
          " control points (median), which are rejected; check the height of the antenna, the "
          "geoid, the datum and the unit of either");
}

}  // namespace

void judgeControl(const ControlConsistency& control, const SystemVector& spread,
                  CalibrationResult& result) {
  warnOfRejected(result);
  objectToRejection(result);
  if (control.plan_scatter > kScatter) {
    result.warnings.push_back(scatterWarning(
        "targets fit in plan", control.plan_rms, control.plan_scatter, "their",
        "check the coordinates and the diameters of the targets and the datum of the trajectory, "
        "and state a realistic sigma_plan"));
  }
  if (control.groups) {
    const std::string what =
        "the control points contradict each other: the strips lie " + control.groups->describe();
    const std::string affected = enlarge(spread, result);
    const std::string effect =
        affected.empty() ? "; no parameter depends on it"
                         : "; the standard deviations of " + affected + " allow for either";
    result.warnings.push_back(what + effect);
    result.verdict.downgrade(CalibrationStatus::parameters_affected, what + effect);
  } else if (control.scatter > kScatter && control.rms > 0.0) {
    result.warnings.push_back(
        scatterWarning("control fits", control.rms, control.scatter, "its",
                       "check the control points and state a realistic sigma"));
  }
}

}  // namespace pcl_als
