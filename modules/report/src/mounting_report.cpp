// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/report/mounting_report.h>
#include <pcl_als/trajectory/calibration_covariance.h>

#include "formatted.h"

namespace pcl_als {
namespace {

constexpr double kNearGimbalLock = 0.1;    ///< sine: standard deviations are tenfold
constexpr double kNoticeableShift = 1e-4;  ///< metres, smallest displacement that is reported

/// Biases of one system with their covariance.
struct SystemBiases {
  std::vector<ParameterEstimate> parameters;
  SystemVector biases;
  SystemMatrix covariance;
  bool has_correlations = true;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};

std::vector<std::string> namesOf(const CalibrationResult& calibration) {
  std::vector<std::string> names;
  for (const SystemEstimate& system : calibration.systems) names.push_back(system.group.name);
  return names;
}

/// The calibration's correlations are those of its first system.
SystemBiases biasesOfSystem(const CalibrationResult& calibration, const std::string& name) {
  const std::vector<std::string> names = namesOf(calibration);
  if (name.empty() && names.size() > 1)
    throw UsageError("the calibration has several systems; name the one of this mounting: " +
                     joined(names));
  SystemBiases chosen;
  chosen.parameters.assign(calibration.parameters.begin(), calibration.parameters.end());
  chosen.covariance = CalibrationCovariance(calibration, {}).parameters();
  for (std::size_t i = 0; i < names.size() && !name.empty(); ++i) {
    if (names[i] != name) continue;
    const SystemEstimate& system = calibration.systems[i];
    chosen.offset = system.offset;
    if (i == 0) break;
    chosen.parameters.assign(system.parameters.begin(), system.parameters.end());
    chosen.has_correlations = false;
    for (int p = 0; p < kSystemParameterCount; ++p) {
      chosen.covariance.row(p).setZero();
      chosen.covariance(p, p) = std::pow(chosen.parameters[std::size_t(p)].std, 2);
    }
  }
  if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
    throw UsageError("the calibration has no system '" + name + "'" +
                     (names.empty() ? "; it has one without a name" : " (" + joined(names) + ")"));
  for (int p = 0; p < kSystemParameterCount; ++p)
    chosen.biases[p] = chosen.parameters[std::size_t(p)].bias;
  return chosen;
}

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
        "of the angles also turns the lever arm, by %.2f mm per metre, which is left out",
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

void remarkOnSystem(MountingReport& report, const SystemBiases& system) {
  if (!system.has_correlations)
    report.remarks.push_back(
        "the calibration states correlations for its first system only: the standard deviations "
        "are those of uncorrelated biases");
  if (!system.offset.isZero(0.0))
    report.remarks.push_back(formatted(
        "the coordinates of this system are offset by %.3f, %.3f, %.3f m (east, north, up), which "
        "is no part of a mounting",
        system.offset.x(), system.offset.y(), system.offset.z()));
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
  const SystemBiases system = biasesOfSystem(calibration, input.system);
  MountingReport report;
  report.input = input;
  report.calibration = file;
  report.parameters = system.parameters;
  const Mounting old{input.angles, input.lever_arm.value_or(Eigen::Vector3d::Zero())};
  report.correction = correctedMounting(input.convention, old, system.biases, system.covariance);
  // Assumed - true: ranges were computed with so much too much, angles with a scale too large.
  report.range_correction = -system.biases[indexOf(SystemParameter::range_bias)];
  report.scan_angle_factor =
      1.0 / (1.0 + system.biases[indexOf(SystemParameter::scan_angle_scale)]);
  remarkOnAngles(report);
  remarkOnLeverArm(report);
  remarkOnModel(report, calibration);
  remarkOnSystem(report, system);
  return report;
}

}  // namespace pcl_als
