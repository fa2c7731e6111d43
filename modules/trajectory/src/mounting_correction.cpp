// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/mounting_correction.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {
namespace {

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// From the scanner to the body, in the axes of the convention.
Eigen::Matrix3d scannerToBody(const MountingConvention& convention, const Eigen::Matrix3d& a) {
  return convention.scanner_to_body ? a : Eigen::Matrix3d(a.transpose());
}

/// From the lever arm as typed to P, right, forward, up.
Eigen::Matrix3d leverAxes(const MountingConvention& convention, const Eigen::Matrix3d& a) {
  const double sign = convention.lever_to_scanner ? 1.0 : -1.0;
  const Eigen::Matrix3d axes = bodyFromAxes(convention.axes);
  return sign *
         (convention.lever_in_body ? axes : Eigen::Matrix3d(axes * scannerToBody(convention, a)));
}

/// J of B' dB = [J d]x for changes d of pitch, roll and heading of B = Rz Rx Ry.
Eigen::Matrix3d boresightAxes(const SystemVector& biases, const Eigen::Matrix3d& boresight) {
  const double roll = biases[indexOf(SystemParameter::boresight_roll)];
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::AngleAxisd(-roll, Eigen::Vector3d::UnitY()) * Eigen::Vector3d::UnitX();
  axes.col(1) = Eigen::Vector3d::UnitY();
  axes.col(2) = boresight.transpose() * Eigen::Vector3d::UnitZ();
  return axes;
}

void checkMounting(const Mounting& mounting, const SystemVector& biases) {
  if (!mounting.angles.allFinite() || !mounting.lever_arm.allFinite())
    throw UsageError("mounting: angles and lever arm must be finite numbers");
  for (const SystemParameterInfo& info : systemParameters()) {
    const std::string refused = refusedBias(info.parameter, biases[indexOf(info.parameter)]);
    if (!refused.empty()) throw UsageError("bias of " + std::string(info.name) + ": " + refused);
  }
}

/// Composition and derivatives of one mounting.
class Composition {
 public:
  Composition(const MountingConvention& convention, const Mounting& before,
              const SystemVector& biases)
      : convention_(convention),
        axes_(bodyFromAxes(convention.axes)),
        boresight_(boresightRotation(biases)),
        boresight_axes_(boresightAxes(biases, boresight_)) {
    const Eigen::Matrix3d a = rotationOf(convention, before.angles);
    const Eigen::Matrix3d turn = axes_.transpose() * boresight_.transpose() * axes_;
    rotation_ = convention.scanner_to_body ? Eigen::Matrix3d(turn * a)
                                           : Eigen::Matrix3d(a * turn.transpose());
    lever_ =
        boresight_.transpose() * (leverAxes(convention, a) * before.lever_arm - biases.head<3>());
    after_.angles = anglesOf(convention, rotation_, before.angles);
    after_.lever_arm = leverAxes(convention, rotation_).transpose() * lever_;
  }

  const Mounting& after() const { return after_; }
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  const Eigen::Vector3d& lever() const { return lever_; }  ///< P_new
  Eigen::Matrix3d matrix() const { return scannerToBody(convention_, rotation_); }

  /// Derivatives of angles (unit of the convention) and lever arm by the biases, 6 x 8.
  Eigen::Matrix<double, 6, kSystemParameterCount> derivatives() const {
    constexpr int kAngles = static_cast<int>(SystemParameter::boresight_pitch);
    Eigen::Matrix<double, 6, kSystemParameterCount> all;
    all.setZero();
    // Both ways of writing a turn: of the scanner in the convention's body axes, of A.
    const Eigen::Matrix3d in_body = -axes_.determinant() * axes_.transpose() * boresight_axes_;
    const Eigen::Matrix3d of_a =
        convention_.scanner_to_body ? in_body : Eigen::Matrix3d(-rotation_ * in_body);
    all.block<3, 3>(0, kAngles) = rotationAxes(convention_, after_.angles).fullPivLu().solve(of_a) /
                                  radiansPer(convention_.unit);
    const Eigen::Matrix3d to_typed = leverAxes(convention_, rotation_).transpose();
    all.block<3, 3>(3, 0) = -to_typed * boresight_.transpose();
    if (convention_.lever_in_body)  // along the scanner's own axes, it turns with the scanner
      all.block<3, 3>(3, kAngles) = to_typed * crossMatrix(lever_) * boresight_axes_;
    return all;
  }

 private:
  const MountingConvention& convention_;
  Eigen::Matrix3d axes_, boresight_, boresight_axes_, rotation_;
  Eigen::Vector3d lever_;
  Mounting after_;
};

/// Old values without the biases, each about its own axis.
Mounting subtractedBiases(const MountingConvention& convention, const Mounting& before,
                          const SystemVector& biases) {
  const Eigen::Matrix3d axes = bodyFromAxes(convention.axes);
  const Eigen::Vector3d turn = axes.determinant() * axes.transpose() *
                               biases.segment<3>(indexOf(SystemParameter::boresight_pitch));
  const double sign = convention.scanner_to_body ? 1.0 : -1.0;
  Mounting subtracted = before;
  for (std::size_t i = 0; i < 3; ++i) {
    const MountingAngle& angle = convention.angles[i];
    subtracted.angles[Eigen::Index(i)] -=
        sign * angle.sign * turn[angle.axis - 'x'] / radiansPer(convention.unit);
  }
  subtracted.lever_arm -=
      leverAxes(convention, rotationOf(convention, before.angles)).transpose() * biases.head<3>();
  return subtracted;
}

}  // namespace

MountingFrame mountingFrame(const MountingConvention& convention, const Mounting& mounting) {
  const Eigen::Matrix3d a = rotationOf(convention, mounting.angles);
  return {bodyFromAxes(convention.axes) * scannerToBody(convention, a),
          leverAxes(convention, a) * mounting.lever_arm};
}

double MountingCorrection::std(int i) const {
  const double variance = covariance(i, i);
  return variance < 0.0 ? 0.0 : std::sqrt(variance);
}

MountingCorrection correctedMounting(const MountingConvention& convention, const Mounting& mounting,
                                     const SystemVector& biases, const SystemMatrix& covariance) {
  checkMounting(mounting, biases);
  const Composition composition(convention, mounting, biases);
  MountingCorrection result;
  result.before = mounting;
  result.after = composition.after();
  result.matrix = composition.matrix();
  result.gimbal_sine = gimbalSine(convention, result.after.angles);
  const Eigen::Matrix<double, 6, kSystemParameterCount> derivatives = composition.derivatives();
  result.covariance = derivatives * covariance * derivatives.transpose();
  if (result.gimbal_sine < kGimbalLock) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    result.covariance.topRows<3>().setConstant(kUnknown);
    result.covariance.leftCols<3>().setConstant(kUnknown);
  }
  result.subtracted = subtractedBiases(convention, mounting, biases);
  const MountingFrame wrong = mountingFrame(convention, result.subtracted);
  const MountingFrame right = mountingFrame(convention, result.after);
  result.subtracted_angle =
      Eigen::AngleAxisd(wrong.body_from_scanner * right.body_from_scanner.transpose()).angle();
  result.subtracted_lever = (wrong.lever_arm - right.lever_arm).norm();
  const Mounting kept{result.after.angles, mounting.lever_arm};
  result.kept_lever = (mountingFrame(convention, kept).lever_arm - composition.lever()).norm();
  return result;
}

}  // namespace pcl_als
