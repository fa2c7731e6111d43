// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include <pcl_als/common/error_source.h>
#include <pcl_als/trajectory/scan_geometry.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// Effects of the error sources on the ground coordinates of a point: east, north, up; metres for a
/// value of one in internal units.
using SourceEffects = Eigen::Matrix<double, 3, kErrorSourceCount>;

/// What the effects of the error sources depend on besides the geometry.
struct SourceReading {
  double time = 0.0;       ///< seconds, on the trajectory's clock
  float intensity = 0.0F;  ///< digital number
  float scan_direction =
      0.0F;  ///< of the mirror: 1 to the left, -1 to the right, 0 unknown; mean of points
};

/** \brief Effects of the error sources (ErrorSource) on points, to first order.
 *
 * With p = (x, y, z) in the body frame, R from body to ground, beam u and range r:
 * range_scale r u; time_offset d/dt (position + R p); mirror_torsion and the errors of the encoder
 * the derivative by the scan angle, R ScanGeometry::turned(), times the sign of the scan or a
 * polynomial; intensity_ranging ln(I / I0) u, with I / I0 between 1/100 and 100; deflection_scale
 * R a (-z e, |(x, y)|) with a = atan2(|(x, y)|, -z) and the direction e of (x, y). slope_ranging
 * depends on the surface: its column is zero, and so are those that do not concern the scanner
 * (ErrorSourceScale::concerns()).
 */
class SourceEffect {
 public:
  explicit SourceEffect(const Trajectory& trajectory) : trajectory_(trajectory) {}

  /// ln(I / I0), with I / I0 between 1/100 and 100; 0 where I0 is unknown.
  static double logIntensity(double intensity, const ErrorSourceScale& scale);

  /// Sets the columns of the offsets of the block, which depend on nothing.
  static void addOffsets(SourceEffects& effects);

  /// Sets the columns of all sources but slope_ranging. An effect that is not defined (unknown
  /// scale, turning or velocity) is zero. Faster for times that are nearly in order.
  void add(const SourceReading& reading, const SensorPose& pose, const ScanGeometry& geometry,
           const ErrorSourceScale& scale, SourceEffects& effects);

  /// Displacement of a point by sources of these values (internal units), metres, slope_ranging
  /// excepted.
  Eigen::Vector3d displacement(const SourceReading& reading, const SensorPose& pose,
                               const Eigen::Vector3d& position, const ErrorSourceScale& scale,
                               const ErrorSourceVector& values);

 private:
  Eigen::Vector3d velocity(double time, const SensorPose& pose, const ScanGeometry& geometry);

  const Trajectory& trajectory_;
  std::size_t before_ = 0, after_ = 0;  ///< cursors
};

}  // namespace pcl_als
