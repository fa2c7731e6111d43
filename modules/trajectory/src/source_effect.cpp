// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/trajectory/source_effect.h>

namespace pcl_als {
namespace {

/// Seconds between the poses of the derivative by time. Errors of a delivered trajectory change
/// from sample to sample, and in a derivative over 10 ms they are noise of the design matrix, which
/// made estimated time offsets a third too small. Motion with periods of 1 s keeps 99 % of its
/// rate, of 0.5 s 93 %.
constexpr double kStep = 0.1;

}  // namespace

Eigen::Vector3d SourceEffect::velocity(double time, const SensorPose& pose,
                                       const ScanGeometry& geometry) {
  const Eigen::Vector3d body = geometry.inBody();
  SensorPose from = pose, to = pose;
  double seconds = 0.0;  // of the last change
  const auto change = [&](double half) {
    const double first = trajectory_.poseAt(time - half, from, before_) ? time - half : time;
    const double last = trajectory_.poseAt(time + half, to, after_) ? time + half : time;
    seconds = last - first;
    return (to.position - from.position + to.rotation * body - from.rotation * body).eval();
  };
  const Eigen::Vector3d inner = change(kStep);
  const Eigen::Vector3d outer = change(2.0 * kStep);
  if (seconds > 3.9 * kStep) return (8.0 * inner - outer) / (12.0 * kStep);  // to the fourth order
  if (seconds > 0.0) return outer / seconds;
  return Eigen::Vector3d::Zero();
}

namespace {

/// Derivative of a point by the logarithm of the angle between its pulse and the axis, body frame.
Eigen::Vector3d deflected(const ScanGeometry& geometry) {
  const Eigen::Vector2d across(geometry.x, geometry.y);
  const double off = across.norm();
  if (off == 0.0) return Eigen::Vector3d::Zero();
  const Eigen::Vector2d outward = -geometry.z / off * across;
  return std::atan2(off, -geometry.z) * Eigen::Vector3d(outward.x(), outward.y(), off);
}

/// Sets the columns of the errors of a mirror's angle.
void addMirror(double scan_direction, const ScanGeometry& geometry, double largest_angle,
               SourceEffects& effects) {
  const Eigen::Vector3d turned = geometry.rotation * geometry.turned();
  effects.col(indexOf(ErrorSource::mirror_torsion)) = scan_direction * turned;
  if (!(largest_angle > 0.0)) return;
  const double u = geometry.beta / largest_angle;
  effects.col(indexOf(ErrorSource::encoder_cubic)) = 0.5 * (5.0 * u * u - 3.0) * u * turned;
  effects.col(indexOf(ErrorSource::encoder_quadratic)) = 0.5 * (3.0 * u * u - 1.0) * turned;
}

}  // namespace

double SourceEffect::logIntensity(double intensity, const ErrorSourceScale& scale) {
  constexpr double kMaximumIntensityRatio = 100.0;  // ratio of intensities
  if (!(scale.median_intensity > 0.0)) return 0.0;
  return std::log(std::clamp(intensity / scale.median_intensity, 1.0 / kMaximumIntensityRatio,
                             kMaximumIntensityRatio));
}

void SourceEffect::addOffsets(SourceEffects& effects) {
  effects.col(indexOf(ErrorSource::east_offset)) = Eigen::Vector3d::UnitX();
  effects.col(indexOf(ErrorSource::north_offset)) = Eigen::Vector3d::UnitY();
  effects.col(indexOf(ErrorSource::height_offset)) = Eigen::Vector3d::UnitZ();
}

void SourceEffect::add(const SourceReading& reading, const SensorPose& pose,
                       const ScanGeometry& geometry, const ErrorSourceScale& scale,
                       SourceEffects& effects) {
  const Eigen::Vector3d beam = geometry.beam();
  addOffsets(effects);
  effects.col(indexOf(ErrorSource::range_scale)) = geometry.range() * beam;
  effects.col(indexOf(ErrorSource::time_offset)) = velocity(reading.time, pose, geometry);
  if (scale.about_axis)
    effects.col(indexOf(ErrorSource::deflection_scale)) = geometry.rotation * deflected(geometry);
  else
    addMirror(reading.scan_direction, geometry, scale.largest_angle, effects);
  if (scale.median_intensity > 0.0) {
    effects.col(indexOf(ErrorSource::intensity_ranging)) =
        logIntensity(reading.intensity, scale) * beam;
  }
}

Eigen::Vector3d SourceEffect::displacement(const SourceReading& reading, const SensorPose& pose,
                                           const Eigen::Vector3d& position,
                                           const ErrorSourceScale& scale,
                                           const ErrorSourceVector& values) {
  SourceEffects effects = SourceEffects::Zero();
  add(reading, pose, scanGeometry(pose, position), scale, effects);
  return effects * values;
}

}  // namespace pcl_als
