// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "block_flight.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <pcl_als/common/errors.h>

#include "strip_error_check.h"

namespace pcl_als {
namespace {

// Radians (half a degree): the effect of such an attitude on biases of 100 arc-seconds that are
// estimated with the vertical model is one arc-second.
constexpr double kVertical = 0.0087;

std::string seconds(double from, double to) {
  std::ostringstream text;
  text.precision(3);
  text << std::fixed << from << " … " << to << " s";
  return text.str();
}

void describeAttitudes(const BlockStrips& strips, const BlockIndex& index, BlockTrajectory& flight,
                       Warnings& warnings) {
  for (const int strip : strips.flown()) {
    const auto i = static_cast<std::size_t>(strip);
    const AttitudeRecovery::Outcome outcome = index.recoveries()[i].assess();
    const std::string text = "strip " + strips.ids[i] + ": " + outcome.remark;
    flight.remarks.push_back(text);
    if (!outcome.linear) warnings.push_back(text + "; it is taken as level");
  }
}

/// Without this, models of linear scanners would interpret points ahead and behind as pitch and
/// crab.
void useNonLinearModel(const std::string& remark, const CalibrationSettings& settings,
                       BlockTrajectory& flight, Warnings& warnings) {
  const std::string text =
      remark + ": the attitude of a scanner that is not linear has to come with the trajectory";
  if (!settings.force)
    throw InputError(text + "; give one with roll, pitch and heading", Hint::nominal_model);
  warnings.push_back(text);
  if (!settings.recover_attitude) return;
  warnings.push_back(
      "the sensor is taken as level with its heading along the course (nominal "
      "attitude)");
  flight.trajectory = std::make_shared<const Trajectory>(flight.trajectory->withNominalAttitude());
  flight.attitude = AttitudeSource::nominal;
}

}  // namespace

void checkTimes(const BlockStrips& strips, const BlockIndex& index) {
  const Trajectory& trajectory = *index.trajectory();
  for (const int strip : strips.flown()) {
    const double start = index.map().startTime(strip), end = index.map().endTime(strip);
    if (start >= trajectory.startTime() && end <= trajectory.endTime()) continue;
    throw InputError("strip " + strips.ids[static_cast<std::size_t>(strip)] + " was measured at " +
                     seconds(start, end) + ", the trajectory covers " +
                     seconds(trajectory.startTime(), trajectory.endTime()) +
                     ": give the trajectory of this flight");
  }
}

HeightError checkTrajectory(const BlockStrips& strips, const CalibrationSettings& settings,
                            TrajectoryPlausibility& plausibility, Warnings& warnings) {
  for (int strip = 0; strip < static_cast<int>(strips.size()); ++strip)
    if (!strips.isFlown(strip)) plausibility.exclude(strip);
  if (settings.reconstructed_height_std) plausibility.nameReconstructed();
  for (const Warning& warning : plausibility.check(settings.force, true))
    warnings.push_back(warning);
  HeightError error = plausibility.heightError();
  if (settings.reconstructed_height_std) {
    double lowest = HUGE_VAL;
    for (int strip = 0; strip < static_cast<int>(strips.size()); ++strip) {
      const double height = plausibility.meanHeight(strip);
      if (height > 0.0) lowest = std::min(lowest, height);
    }
    error = uncertainHeight(*settings.reconstructed_height_std, lowest);
  }
  plausibility.release();
  return error;
}

BlockTrajectory flightOf(const BlockStrips& strips, const BlockIndex& index,
                         const CalibrationSettings& settings, Warnings& warnings) {
  BlockTrajectory flight;
  flight.trajectory = index.trajectory();
  if (flight.trajectory->hasAttitude()) flight.attitude = AttitudeSource::trajectory;
  if (flight.trajectory->attitudeIsNominal()) flight.attitude = AttitudeSource::nominal;
  if (index.recoveries().empty()) return flight;
  describeAttitudes(strips, index, flight, warnings);
  AttitudeRecovery all(flight.trajectory);
  for (const int strip : strips.flown())
    all.merge(index.recoveries()[static_cast<std::size_t>(strip)]);
  const AttitudeRecovery::Outcome outcome = all.recover();
  if (!outcome.linear) {
    useNonLinearModel(outcome.remark, settings, flight, warnings);
  } else if (!settings.recover_attitude) {
    if (outcome.found && outcome.size > kVertical)
      warnings.emplace_back(
          "the sensor is taken as vertical and aligned with the flight line, "
          "it was not: " +
              outcome.remark + "; standard deviations do not include that",
          Hint::recover_attitude);
  } else {
    flight.trajectory = outcome.flight;
    if (outcome.found) {
      flight.recovered = outcome.attitude;
      flight.attitude = AttitudeSource::points;
    } else {
      warnings.push_back(outcome.remark);
    }
  }
  return flight;
}

BlockScanner findScanner(const BlockStrips& strips, const BlockIndex& index,
                         BlockTrajectory& flight) {
  BlockScanner scanner;
  if (index.scanners().empty()) return scanner;
  std::vector<const ScannerDetection*> detections;
  for (const int strip : strips.flown())
    detections.push_back(&index.scanners()[static_cast<std::size_t>(strip)]);
  std::map<ScannerPattern, std::size_t> patterns;
  for (const ScannerDetection* strip : detections) ++patterns[strip->assess().pattern];
  const std::size_t cones = patterns[ScannerPattern::conical];
  const std::size_t rosettes = patterns[ScannerPattern::rosette];
  scanner.conical = 2 * cones > detections.size();
  scanner.rosette = 2 * rosettes > detections.size();
  scanner.about_axis = 2 * (cones + rosettes) > detections.size();
  const ScanPlanes planes = scanPlanes(detections);
  if (planes.empty()) return scanner;
  flight.remarks.push_back("the scanner has " + std::to_string(planes.size()) +
                           " scan planes; scan angles are those in the plane of each pulse");
  flight.trajectory = std::make_shared<const Trajectory>(flight.trajectory->withScanPlanes(planes));
  return scanner;
}

}  // namespace pcl_als
