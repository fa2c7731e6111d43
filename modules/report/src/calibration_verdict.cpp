// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "calibration_verdict.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/drawing/calibration_plots.h>
#include <pcl_als/quality/accuracy_standards.h>

namespace pcl_als {
namespace {

/// RMS of all pairs together.
double rmsOf(const std::vector<PairFit>& pairs, double PairFit::*rms) {
  double squares = 0.0, count = 0.0;
  for (const PairFit& pair : pairs) {
    const auto weight = static_cast<double>(pair.correspondences);
    squares += weight * pair.*rms * pair.*rms;
    count += weight;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

/// "quality level 0", "quality levels 1 and 2": those whose limit between swaths this is.
std::string levelsWith(double limit) {
  std::string levels;
  int count = 0;
  for (const QualityLevelLimits& one : qualityLevels()) {
    if (one.swath_overlap_rmsdz != limit) continue;
    levels += (count++ == 0 ? "" : " and ") + std::to_string(one.level);
  }
  return (count == 1 ? "quality level " : "quality levels ") + levels;
}

std::string againstSpecification(double rms) {
  const std::string caution =
      " This is a distance along the surface normal where the calibration measured; pcl_als_check "
      "measures what the specification asks for.";
  if (const auto level = swathQualityLevel(rms)) {
    const double limit = qualityLevels()[static_cast<std::size_t>(*level)].swath_overlap_rmsdz;
    return "The fit after calibration is inside the " + centimetres(limit) +
           " that the USGS Lidar Base Specification allows between swaths at " + levelsWith(limit) +
           "." + caution;
  }
  return "The fit after calibration is outside what the USGS Lidar Base Specification allows "
         "between swaths at any quality level." +
         caution;
}

void addParameters(const CalibrationResult& result, std::vector<std::string>& sentences) {
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = result[info.parameter];
    if (estimate.status == ParameterStatus::estimated) {
      sentences.push_back(headingOf(info.parameter) + ": " +
                          estimateText(info.parameter, estimate) +
                          (estimate.reason.empty() ? "." : ", " + estimate.reason + "."));
    } else if (estimate.status == ParameterStatus::not_estimable) {
      sentences.push_back(headingOf(info.parameter) + ": not determined (" +
                          (estimate.reason.empty() ? "the data do not show it" : estimate.reason) +
                          ").");
    }
  }
}

void addControl(const CalibrationResult& result, std::vector<std::string>& sentences) {
  double squares_before = 0.0, squares_after = 0.0, count = 0.0;
  for (const ControlFit& fit : result.control) {
    const auto weight = static_cast<double>(fit.points);
    squares_before += weight * fit.rms_before * fit.rms_before;
    squares_after += weight * fit.rms_after * fit.rms_after;
    count += weight;
  }
  if (count == 0.0) return;
  sentences.push_back("Heights fit control with an RMS of " +
                      centimetres(std::sqrt(squares_after / count)) + " (" +
                      centimetres(std::sqrt(squares_before / count)) + " as delivered; " +
                      grouped(static_cast<std::size_t>(count)) + " differences in " +
                      std::to_string(result.control.size()) + " strips).");
}

void addTargets(const CalibrationResult& result, std::vector<std::string>& sentences) {
  double squares_before = 0.0, squares_after = 0.0, count = 0.0;
  for (const ControlPointFit& fit : result.control_points) {
    if (!fit.isInPlan() || !fit.used) continue;
    squares_before += fit.before * fit.before;
    squares_after += fit.after * fit.after;
    count += 0.5;
  }
  if (count == 0.0) return;
  sentences.push_back("Targets fit in plan with an RMS of " +
                      centimetres(std::sqrt(squares_after / count)) + " (" +
                      centimetres(std::sqrt(squares_before / count)) + " as delivered; " +
                      grouped(static_cast<std::size_t>(count)) +
                      " targets, distances of their mean places in the strips).");
}

/// The largest error of the trajectory, and how many there are.
void addLargeCorrections(const CalibrationResult& result, std::vector<std::string>& sentences) {
  if (result.large_corrections.empty()) return;
  const LargeCorrection& first = result.large_corrections.front();
  std::string size = sizeText(first);
  if (const std::size_t at = size.find("+-"); at != std::string::npos) size.replace(at, 2, "±");
  sentences.push_back("The trajectory is wrong by more than ordinary errors in " +
                      counted(result.large_corrections.size(), "place") + ", most in strip " +
                      first.strip + ", " + intervalText(first) + ": " + size +
                      "; see the table and the map.");
}

}  // namespace

std::string headingOf(SystemParameter parameter) {
  std::string name = plainName(parameter);
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

Verdict verdictOf(const CalibrationResult& result) {
  Verdict verdict;
  const bool compared = result.misfit.points > 0;
  const double before =
      compared ? result.misfit.rms_before : rmsOf(result.pairs, &PairFit::rms_before);
  const double after =
      compared ? result.misfit.rms_after : rmsOf(result.pairs, &PairFit::rms_after);
  const bool complete = std::none_of(
      result.parameters.begin(), result.parameters.end(), [](const ParameterEstimate& e) {
        return e.status == ParameterStatus::not_estimable || !e.determined;
      });
  if (!result.verdict.usable()) {
    verdict.grade = VerdictGrade::bad;
    verdict.headline =
        "No reliable answer: do not apply this result (" + result.verdict.text() + ").";
  } else {
    verdict.grade = complete ? VerdictGrade::good : VerdictGrade::attention;
    verdict.headline = "The strips agree to " + centimetres(after) + " after calibration (" +
                       centimetres(before) + " as delivered).";
    if (!complete) verdict.headline += " Not every parameter is determined.";
  }
  if (result.verdict.usable())
    verdict.sentences.push_back("Verdict: " + result.verdict.text() + ".");
  addParameters(result, verdict.sentences);
  if (result.verdict.usable() && !result.pairs.empty()) {
    verdict.sentences.push_back(againstSpecification(after));
  }
  addControl(result, verdict.sentences);
  addTargets(result, verdict.sentences);
  addLargeCorrections(result, verdict.sentences);
  const auto worst = std::max_element(
      result.pairs.begin(), result.pairs.end(),
      [](const PairFit& a, const PairFit& b) { return a.rms_after < b.rms_after; });
  if (result.pairs.size() > 1) {
    verdict.sentences.push_back("The pair that fits least is " + worst->a + " and " + worst->b +
                                " with " + centimetres(worst->rms_after) + " (" +
                                centimetres(worst->rms_before) + " as delivered).");
  }
  return verdict;
}

}  // namespace pcl_als
