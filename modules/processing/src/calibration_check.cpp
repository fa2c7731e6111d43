// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include <pcl_als/calibration/survey_calibration.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/io/prior_file.h>
#include <pcl_als/processing/calibration_check.h>

namespace pcl_als {
namespace {

CalibrationOptions settingsFor(const BiasPrior& prior, const CalibrationCheckOptions& options) {
  constexpr std::size_t kPoints = 300'000, kCandidates = 20'000;
  CalibrationOptions all;
  all.gps_week = options.gps_week;
  CalibrationSettings& settings = all.settings;
  settings.shared_errors.biases = prior;
  settings.selection.point_budget = kPoints;
  settings.candidates = kCandidates;
  settings.diagnose = false;
  settings.force = options.force;
  settings.threads = options.threads;
  return all;
}

/// The values of a calibration are what is to be checked: one that is contradicted is not released.
BiasPrior priorOf(const CalibrationResult& calibration) {
  if (!calibration.systems.empty()) throw InputError("it has several systems");
  PriorFile file;
  file.name = "the calibration";
  file.earlier = calibration;
  BiasPrior prior = file.prior();
  prior.of_other_missions = false;
  return prior;
}

}  // namespace

std::string CalibrationCheck::text(const std::string& name) const {
  if (!possible)
    return "whether the calibration " + name +
           " holds for these strips was not checked: " + not_checked;
  char misfit[80];
  std::snprintf(misfit, sizeof misfit, "misfit %.1f -> %.1f cm", 100.0 * rms_before,
                100.0 * rms_with_calibration);
  std::string text = "the calibration " + name + (holds() ? " holds" : " does not hold") +
                     " for these strips: " + misfit;
  if (!differences.empty()) {
    const PriorDifference& largest = differences.front();
    text += "; " + std::string(infoOf(largest.parameter).name) + " differs by " +
            shortValue(largest.parameter, largest.change) + " +- " +
            inUnit(largest.parameter, largest.change_std);
  }
  return holds() ? text : text + "; calibrate the system with these strips";
}

bool mayBeOfAnotherFlight(const CalibrationResult& calibration,
                          const std::vector<std::string>& files, const Trajectory& flight) {
  if (!calibration.strip_errors.empty() || !calibration.recovered_attitude.passes().empty())
    return isOfAnotherFlight(calibration, flight.startTime(), flight.endTime());
  const auto nameOf = [](const std::string& path) {
    return std::filesystem::path(path).filename();
  };
  std::set<std::filesystem::path> calibrated;
  for (const std::string& input : calibration.inputs) calibrated.insert(nameOf(input));
  return std::none_of(files.begin(), files.end(),
                      [&](const std::string& file) { return calibrated.count(nameOf(file)) > 0; });
}

CalibrationCheck checkCalibration(const std::vector<std::string>& files,
                                  const CalibrationResult& calibration,
                                  const std::shared_ptr<const Trajectory>& flight,
                                  const CalibrationCheckOptions& options,
                                  const ProgressCallback& progress) {
  if (!flight) throw UsageError("check of a calibration: no trajectory is given");
  CalibrationCheck check;
  try {
    const BiasPrior prior = priorOf(calibration);
    SurveyReader survey(files, options.threads, {}, options.processes);
    const CalibrationResult result =
        calibrateSurvey(survey, flight, settingsFor(prior, options), progress).result;
    check.rms_before = result.misfit.rms_before;
    check.rms_with_calibration = result.rms_with_prior;
    check.differences = result.prior_differences;
    check.possible = !result.pairs.empty();
    if (!check.possible) check.not_checked = "no two of them have a common surface";
  } catch (const InputError& error) {
    check.not_checked = error.what();
  }
  return check;
}

}  // namespace pcl_als
