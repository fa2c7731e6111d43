// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "calibration_judgement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {
namespace {

constexpr double kSignificant = 2.0;  // standard deviations of the change of the misfit
// share of the misfit as delivered: a smaller change is no change
constexpr double kRelevant = 0.01;

constexpr double kContradicting = 5.0;  // standard deviations of a bias that changes no misfit
/// Mountings are known to a fraction of this angle.
constexpr double kLargestMisalignment = 1800.0 * kRadiansPerArcsec;

std::string centimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f cm", 100.0 * metres);
  return text;
}

/// "3.34 cm after the calibration, 3.10 cm as delivered (change +0.24 +- 0.05 cm at 5310 points)"
std::string describe(const MisfitChange& misfit) {
  char change[96];
  if (std::isfinite(misfit.change_std)) {
    std::snprintf(change, sizeof change, "%+.2f +- %.2f cm at %zu points", 100.0 * misfit.change(),
                  100.0 * misfit.change_std, misfit.points);
  } else {
    std::snprintf(change, sizeof change, "%+.2f cm at %zu points of one area",
                  100.0 * misfit.change(), misfit.points);
  }
  return centimetres(misfit.rms_after) + " after the calibration, " +
         centimetres(misfit.rms_before) + " as delivered (change " + change + ")";
}

bool improvedSignificantly(const MisfitChange& misfit) {
  // false where the standard deviation is unknown
  return misfit.change() < -kSignificant * misfit.change_std;
}

/// 99 % quantile of the chi-squared distribution (Wilson and Hilferty 1931; to 1 % for 1 and more).
double chiSquared99(double degrees) {
  constexpr double kNormal99 = 2.3263;
  const double ninth = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - ninth + kNormal99 * std::sqrt(ninth), 3);
}

void judgeDetermination(const std::vector<SystemParameter>& requested, CalibrationResult& result) {
  if (result.correlation_order.empty()) {
    result.verdict.downgrade(CalibrationStatus::not_determined,
                             "no parameter can be determined from this block");
    return;
  }
  for (const SystemParameter p : requested) {
    const ParameterEstimate& estimate = result[p];
    if (estimate.status != ParameterStatus::not_estimable) continue;
    result.verdict.downgrade(
        CalibrationStatus::not_determined,
        std::string(infoOf(p).name) + " is not determined (" + estimate.reason + ")");
  }
}

void judgeMisfit(CalibrationResult& result) {
  const MisfitChange& misfit = result.misfit;
  if (misfit.points == 0 || result.correlation_order.empty()) return;
  const double change = misfit.change();
  const bool relevant = change > kRelevant * misfit.rms_before;
  if (relevant && change > kSignificant * misfit.change_std) {
    result.verdict.downgrade(
        CalibrationStatus::no_improvement,
        "the misfit between the strips is larger after the calibration: " + describe(misfit));
  } else if (relevant && biasesAreSignificant(result)) {
    result.verdict.downgrade(
        CalibrationStatus::no_improvement,
        "the biases differ from zero, but the misfit between the strips is no smaller: " +
            describe(misfit));
  }
}

/// A bias of the system would reduce the misfit: what does not may be a deformation of the strips,
/// which part of the block shares and the standard deviation does not contain.
void warnOfIneffectiveBiases(CalibrationResult& result) {
  std::string names;
  for (const SystemParameter p : result.correlation_order) {
    const ParameterEstimate& estimate = result[p];
    if (!(std::abs(estimate.bias) > kContradicting * estimate.std)) continue;
    char text[64];
    std::snprintf(text, sizeof text, " by %.1f standard deviations",
                  std::abs(estimate.bias) / estimate.std);
    names += (names.empty() ? "" : ", ") + std::string(infoOf(p).name) + text;
  }
  if (names.empty()) return;
  result.warnings.push_back(
      {"biases that differ from zero, but do not reduce the misfit between the strips "
       "significantly: " +
           names +
           "; they may describe deformations of the strips or the ground instead of the system: "
           "compare the calibrations of parts of the block before they are applied elsewhere",
       Hint::strips});
}

/// A boresight angle beyond all mountings is another convention of the attitude, to which the
/// calibration fits the points of this block alone.
void warnOfLargeAngles(CalibrationResult& result) {
  for (const SystemParameter p : {SystemParameter::boresight_pitch, SystemParameter::boresight_roll,
                                  SystemParameter::boresight_heading}) {
    const double angle = result[p].bias;
    if (result[p].status != ParameterStatus::estimated || std::abs(angle) < kLargestMisalignment)
      continue;
    char value[32];
    std::snprintf(value, sizeof value, "%.2f", angle / (3600.0 * kRadiansPerArcsec));
    const char* cause =
        p == SystemParameter::boresight_heading
            ? "the headings of the trajectory may count from true north and the coordinates from "
              "grid north, or be the direction of flight"
            : "the trajectory may lack the nominal angles of the mounting, or have other axes";
    result.warnings.push_back({std::string(infoOf(p).name) + " is " + value +
                                   " degrees, more than a misalignment of the mounting: " + cause +
                                   "; such a value does not apply to other surveys",
                               p == SystemParameter::boresight_heading ? Hint::none : Hint::axes});
  }
}

/// "-88 +- 106 arcsec"
std::string valueText(SystemParameter p, const ParameterEstimate& estimate) {
  return shortValue(p, estimate.bias) + " +- " + inUnit(p, estimate.std);
}

/// Why an estimate tells nothing; empty where it does.
std::string whyUndetermined(SystemParameter p, const ParameterEstimate& estimate,
                            const ScanGeometry& edge, double limit) {
  const double on_points = (designBlock(edge).col(indexOf(p)) * estimate.std).norm();
  const bool differs = std::abs(estimate.bias) > kSignificant * estimate.std;
  if (estimate.status != ParameterStatus::estimated || differs || !(on_points > limit)) return {};
  return "not determined: it does not differ from zero, and one standard deviation moves points at "
         "the edge of the swath by " +
         centimetres(on_points);
}

}  // namespace

void nameUndetermined(const ScanGeometry& edge, double limit, CalibrationResult& result) {
  std::string names;
  for (const SystemParameterInfo& info : systemParameters()) {
    const SystemParameter p = info.parameter;
    const std::string reason = whyUndetermined(p, result[p], edge, limit);
    if (reason.empty()) continue;
    result[p].reason += (result[p].reason.empty() ? "" : "; ") + reason;
    result[p].determined = false;
    names += (names.empty() ? "" : ", ") + std::string(info.name) + " (" + valueText(p, result[p]) +
             ", up to " + centimetres((designBlock(edge).col(indexOf(p)) * result[p].std).norm()) +
             " at the edge of the swath)";
    for (ErrorFinding& finding : result.diagnosis)
      if (finding.source == info.name) finding.determined = false;
  }
  for (SystemEstimate& system : result.systems) {
    for (const SystemParameterInfo& info : systemParameters()) {
      ParameterEstimate& estimate = system.parameters[indexOf(info.parameter)];
      const std::string reason = whyUndetermined(info.parameter, estimate, edge, limit);
      if (reason.empty() || !estimate.reason.empty()) continue;
      estimate.reason = reason;
      estimate.determined = false;
    }
  }
  if (names.empty()) return;
  result.verdict.reason +=
      (result.verdict.reason.empty() ? "" : "; ") + ("not determined: " + names);
}

bool biasesAreSignificant(const CalibrationResult& result) {
  const auto size = static_cast<Eigen::Index>(result.correlation_order.size());
  if (size == 0) return false;
  Eigen::VectorXd standardised(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const ParameterEstimate& p = result[result.correlation_order[static_cast<std::size_t>(i)]];
    standardised[i] = p.std > 0.0 ? p.bias / p.std : 0.0;
  }
  const double chi_squared = standardised.dot(solveSymmetric(result.correlation, standardised));
  return chi_squared > chiSquared99(static_cast<double>(size));
}

void judgeCalibration(const std::vector<SystemParameter>& requested,
                      const std::string& not_converged, CalibrationResult& result) {
  judgeDetermination(requested, result);
  warnOfLargeAngles(result);
  if (!not_converged.empty()) {
    result.verdict.downgrade(CalibrationStatus::not_converged, not_converged);
  }
  judgeMisfit(result);
  if (!result.verdict.usable() || !result.verdict.reason.empty()) return;
  if (result.misfit.points == 0) {
    result.verdict.reason = "the adjustment converged";
  } else if (improvedSignificantly(result.misfit)) {
    result.verdict.reason = "the misfit between the strips is smaller: " + describe(result.misfit);
  } else {
    result.verdict.reason =
        "the misfit between the strips does not change significantly: " + describe(result.misfit);
    warnOfIneffectiveBiases(result);
  }
}

}  // namespace pcl_als
