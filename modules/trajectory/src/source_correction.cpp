// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "source_correction.h"

#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/source_effect.h>

namespace pcl_als::detail {

void SourceCorrection::requireColumns(const PointColumns& points) const {
  const auto requireColumn = [&](ErrorSource source, const void* column, const char* what) {
    if (values_[indexOf(source)] == 0.0 || column != nullptr) return;
    throw UsageError("the calibration corrects " + std::string(infoOf(source).title) +
                     ", for which the points need " + what);
  };
  requireColumn(ErrorSource::intensity_ranging, points.intensity, "an intensity");
  requireColumn(ErrorSource::mirror_torsion, points.scan_direction, "a scan direction");
}

void SourceCorrection::add(const PointColumns& points, std::size_t count, bool invert,
                           const EffectColumns& change) const {
  requireColumns(points);
  SourceEffect effect(*flight_);
  SensorPose pose;
  std::size_t cursor = 0;
  const double sign = invert ? 1.0 : -1.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d position(points.x[i], points.y[i], points.z[i]);
    SourceReading reading;
    reading.time = points.time[i];
    if (points.intensity != nullptr) reading.intensity = points.intensity[i];
    if (points.scan_direction != nullptr)
      reading.scan_direction = static_cast<float>(points.scan_direction[i]);
    if (!std::isfinite(reading.time) || !flight_->poseAt(reading.time, pose, cursor)) continue;
    const Eigen::Vector3d moved =
        sign * effect.displacement(reading, pose, position, scale_, values_);
    change.x[i] += moved.x(), change.y[i] += moved.y(), change.z[i] += moved.z();
  }
}

}  // namespace pcl_als::detail
