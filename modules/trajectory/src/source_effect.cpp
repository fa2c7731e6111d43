// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/trajectory/source_effect.h>

namespace pcl_als {

Eigen::Vector3d SourceEffect::velocity(double time, const SensorPose& pose,
                                       const ScanGeometry& geometry) {
  // Seconds: the time offsets in question are a few milliseconds.
  constexpr double kHalf = 0.005;
  SensorPose from = pose, to = pose;
  const double first = trajectory_.poseAt(time - kHalf, from, before_) ? time - kHalf : time;
  const double last = trajectory_.poseAt(time + kHalf, to, after_) ? time + kHalf : time;
  if (first == last) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d body = geometry.inBody();
  return (to.position - from.position + to.rotation * body - from.rotation * body) / (last - first);
}

void SourceEffect::add(const SourceReading& reading, const SensorPose& pose,
                       const ScanGeometry& geometry, const ErrorSourceScale& scale,
                       SourceEffects& effects) {
  constexpr double kMost = 100.0;  // ratio of intensities
  const Eigen::Vector3d beam = geometry.beam();
  effects.col(indexOf(ErrorSource::range_scale)) = geometry.range() * beam;
  effects.col(indexOf(ErrorSource::time_offset)) = velocity(reading.time, pose, geometry);
  const Eigen::Vector3d turned = geometry.rotation * Eigen::Vector3d(geometry.z, 0.0, -geometry.x);
  effects.col(indexOf(ErrorSource::mirror_torsion)) = reading.turning * turned;
  if (scale.largest_angle > 0.0) {
    const double u = geometry.beta / scale.largest_angle;
    effects.col(indexOf(ErrorSource::encoder_cubic)) = 0.5 * (5.0 * u * u - 3.0) * u * turned;
    effects.col(indexOf(ErrorSource::encoder_quadratic)) = 0.5 * (3.0 * u * u - 1.0) * turned;
  }
  if (scale.median_intensity > 0.0) {
    const double ratio = std::clamp(reading.intensity / scale.median_intensity, 1.0 / kMost, kMost);
    effects.col(indexOf(ErrorSource::intensity_ranging)) = std::log(ratio) * beam;
  }
}

}  // namespace pcl_als
