// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/trajectory/calibration_covariance.h>
#include <pcl_als/trajectory/scan_geometry.h>
#include <pcl_als/trajectory/trajectory_correction.h>
#include <pcl_als/trajectory/trajectory_errors.h>

namespace pcl_als {
namespace {

/// Roll, pitch and heading of Rz(-heading) Rx(pitch) Ry(roll); the heading near that of \a sample.
void setAngles(const Eigen::Matrix3d& rotation, TrajectorySample& sample) {
  const double heading = std::atan2(rotation(0, 1), rotation(1, 1));
  sample.heading += std::remainder(heading - sample.heading, 2.0 * kPi);
  sample.pitch = std::asin(std::min(1.0, std::max(-1.0, rotation(2, 1))));
  sample.roll = std::atan2(-rotation(2, 0), rotation(2, 2));
}

Eigen::Vector3d leverArmStd(const CalibrationResult& calibration) {
  return {calibration[SystemParameter::lever_arm_x].std,
          calibration[SystemParameter::lever_arm_y].std,
          calibration[SystemParameter::lever_arm_z].std};
}

/// A posteriori standard deviations of corrected samples.
class SampleDeviations {
 public:
  SampleDeviations(const CalibrationResult& calibration, bool strip_corrections)
      : strip_corrections_(strip_corrections), covariance_(calibration, {strip_corrections, {}}) {}

  /// \a rotation: from body to ground.
  void add(double time, const Eigen::Matrix3d& rotation, CorrectedTrajectory& corrected) const {
    Eigen::Vector3d& position = corrected.position_std.emplace_back();
    Eigen::Vector3d& angles = corrected.angles_std.emplace_back();
    position.setConstant(TrajectoryErrorKnot::kUnknown);
    angles = position;
    if (!strip_corrections_ || !covariance_.isKnown(time)) return;
    const CalibrationCovariance::Matrix all = covariance_.at(time);
    Eigen::Matrix<double, 3, 6> effect;  // of lever arm and position
    effect << rotation, Eigen::Matrix3d::Identity();
    Eigen::Matrix<double, 6, 6> both;
    constexpr int kPosition = kSystemParameterCount;
    both << all.topLeftCorner<3, 3>(), all.block<3, 3>(0, kPosition), all.block<3, 3>(kPosition, 0),
        all.block<3, 3>(kPosition, kPosition);
    position = (effect * both * effect.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
    angles = all.diagonal().tail<3>().cwiseSqrt();
  }

 private:
  bool strip_corrections_;
  CalibrationCovariance covariance_;
};

}  // namespace

CorrectedTrajectory correctTrajectory(const std::vector<TrajectorySample>& samples,
                                      const CalibrationResult& calibration,
                                      std::shared_ptr<const Trajectory> flight,
                                      const SystemCorrection::Options& options) {
  const SystemCorrection correction(calibration, std::move(flight), options);
  const TrajectoryErrors errors(options.strip_corrections ? calibration.strip_errors
                                                          : std::vector<StripErrors>());
  const SystemVector biases = calibration.biases();
  const Eigen::Matrix3d boresight = boresightRotation(biases);
  const Eigen::Vector3d lever_std = leverArmStd(calibration);
  const SampleDeviations deviations(calibration, options.strip_corrections);
  CorrectedTrajectory corrected;
  corrected.flight_remark = correction.flightRemark();
  std::size_t cursor = 0;
  for (TrajectorySample sample : samples) {
    SensorPose pose;
    if (!correction.flight()->poseAt(sample.time, pose, cursor) ||
        !correction.knowsAttitude(sample.time)) {
      ++corrected.excluded;
      continue;
    }
    TrajectoryErrorKnot error;
    errors.at(sample.time, error);
    sample.position -=
        error.position + pose.rotation * biases.head<3>() + blockOffset(calibration.sources);
    if (!error.angles.isZero(0.0) && sample.hasAttitude()) {
      SystemVector both = biases;
      both.segment<3>(indexOf(SystemParameter::boresight_pitch)) += error.angles;
      const Eigen::Matrix3d rotation =
          groundFromBody(sample.roll, sample.pitch, sample.heading).toRotationMatrix();
      setAngles(rotation * boresightRotation(both).transpose() * boresight, sample);
    } else if (!error.angles.isZero(0.0)) {
      corrected.angles_excluded = true;
    }
    corrected.samples.push_back(sample);
    corrected.lever_arm_variance.push_back(pose.rotation.cwiseAbs2() * lever_std.cwiseAbs2());
    deviations.add(sample.time, pose.rotation, corrected);
  }
  return corrected;
}

}  // namespace pcl_als
