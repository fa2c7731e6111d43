// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <Eigen/Geometry>

#include <pcl_als/report/mounting_report.h>
#include <pcl_als/trajectory/calibration_covariance.h>

#include "formatted.h"

namespace pcl_als {
namespace {

constexpr double kNearGimbalLock = 0.1;    ///< sine: standard deviations are tenfold
constexpr double kNoticeableShift = 1e-4;  ///< metres, smallest displacement that is reported

/// Whether the calibration says nothing of three parameters.
bool isUntouched(const MountingReport& report, SystemParameter first) {
  for (int i = 0; i < 3; ++i) {
    const ParameterEstimate& estimate = report.parameters[std::size_t(indexOf(first) + i)];
    if (estimate.status == ParameterStatus::estimated || estimate.bias != 0.0) return false;
  }
  return true;
}

void remarkOnAngles(MountingReport& report) {
  const double sine = report.correction.gimbal_sine;
  if (sine < kGimbalLock)
    report.remarks.push_back(
        "gimbal lock: the first and the third rotation have the same axis, so that only their sum "
        "or difference is determined; one angle was kept, and the angles have no standard "
        "deviations. The rotation is exact");
  else if (sine < kNearGimbalLock)
    report.remarks.push_back(formatted(
        "near gimbal lock: the first and the third angle have standard deviations %.0f times those "
        "of the rotation, and change together; type in all three with all digits",
        1.0 / sine));
  if (isUntouched(report, SystemParameter::boresight_pitch))
    report.remarks.push_back("no boresight angle was estimated: the rotation is unchanged");
}

void remarkOnLeverArm(MountingReport& report) {
  if (!report.input.lever_arm) {
    report.remarks.push_back(formatted(
        "the old lever arm was not given: its values are those to be added to it. The correction "
        "of the angles also turns the lever arm, by %.2f mm per metre, which is not included",
        1e3 *
            Eigen::AngleAxisd(
                mountingFrame(report.input.convention, report.correction.after).body_from_scanner *
                mountingFrame(report.input.convention, report.correction.before)
                    .body_from_scanner.transpose())
                .angle()));
  } else if (isUntouched(report, SystemParameter::lever_arm_x) &&
             report.correction.kept_lever > kNoticeableShift) {
    report.remarks.push_back(formatted(
        "the lever arm was not estimated: it is only turned with the scanner about the origin of "
        "the body. With the old lever arm all points would be displaced by %.1f mm",
        1e3 * report.correction.kept_lever));
  }
}

void remarkOnModel(MountingReport& report, const CalibrationResult& calibration) {
  if (calibration.attitude == AttitudeSource::none ||
      calibration.attitude == AttitudeSource::points)
    report.remarks.push_back(
        "the calibration is quasi-rigorous: it did not use the attitude of the trajectory, as the "
        "program does. Its angles differ from those of a rigorous one by about the bias times the "
        "roll, pitch and crab of the flight");
  if (calibration.attitude == AttitudeSource::nominal)
    report.remarks.push_back(
        "the calibration took the sensor as level with its heading along the course: the angles "
        "contain the mean pitch and crab of the flight against the body");
  std::string others;
  for (const ErrorSourceInfo& info : errorSources()) {
    if (calibration.sources[indexOf(info.source)] != 0.0)
      others += (others.empty() ? "" : ", ") + std::string(info.name);
  }
  if (!others.empty())
    report.remarks.push_back("the calibration also corrects " + others +
                             ", which are no part of a mounting");
}

/// \param first name of the first system
void remarkOnSystem(MountingReport& report, const CalibrationResult& one,
                    const std::string& first) {
  if (report.input.system != first)
    report.remarks.push_back(
        "the calibration states correlations for its first system only: the standard deviations "
        "are those of uncorrelated biases");
  const Eigen::Vector3d offset =
      one.systems.empty() ? Eigen::Vector3d::Zero() : one.systems.front().offset;
  if (!offset.isZero(0.0))
    report.remarks.push_back(formatted(
        "the coordinates of this system are offset by %.3f, %.3f, %.3f m (east, north, up), which "
        "is no part of a mounting",
        offset.x(), offset.y(), offset.z()));
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = report.parameters[std::size_t(indexOf(info.parameter))];
    if (estimate.status == ParameterStatus::estimated && !estimate.determined)
      report.remarks.push_back(std::string(info.name) +
                               " is not determined, but the other values are right only with it");
  }
}

}  // namespace

MountingReport reportMounting(const CalibrationResult& calibration, const std::string& file,
                              const MountingInput& input) {
  const CalibrationResult one = calibrationOfSystem(calibration, input.system);
  const SystemVector biases = one.biases();
  MountingReport report;
  report.input = input;
  report.calibration = file;
  report.parameters.assign(one.parameters.begin(), one.parameters.end());
  const Mounting old{input.angles, input.lever_arm.value_or(Eigen::Vector3d::Zero())};
  report.correction =
      correctedMounting(input.convention, old, biases, CalibrationCovariance(one, {}).parameters());
  // Assumed - true: ranges were computed with so much too much, angles with a scale too large.
  report.range_correction = -biases[indexOf(SystemParameter::range_bias)];
  report.scan_angle_factor = 1.0 / (1.0 + biases[indexOf(SystemParameter::scan_angle_scale)]);
  remarkOnAngles(report);
  remarkOnLeverArm(report);
  remarkOnModel(report, calibration);
  remarkOnSystem(report, one,
                 input.system.empty() ? std::string() : calibration.systems.front().group.name);
  return report;
}

}  // namespace pcl_als
