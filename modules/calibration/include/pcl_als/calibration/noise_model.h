// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {

/** \brief Random errors of one return: what is left when every systematic effect is removed.
 *
 * The covariance of a ground point is built in the frame of its pulse: range noise along the beam,
 * pointing noise times range across it, the footprint's share of it where the surface is not
 * perpendicular to the beam, and the short-term noise of the trajectory in all directions. What a
 * strip's points share (slow trajectory errors) is not noise: see SharedErrorModel.
 */
struct NoiseModel {
  double range = 0.02;  ///< metres, standard deviation along the beam
  double angle =
      10.0 * kRadiansPerArcsec;  ///< radians, pointing (encoder and attitude jitter), each axis
  double position = 0.005;       ///< metres, short-term trajectory noise, each axis
  double beam_divergence =
      0.3e-3;  ///< radians, full angle at 1/e^2; the return comes from anywhere in the footprint

  /// Throws UsageError naming the value that is not finite or negative, or if all are zero.
  void validate() const;

  /// Covariance of a point (m^2, ground frame: east, north, up).
  Eigen::Matrix3d pointCovariance(const ScanGeometry& geometry) const;
  /// The part of it that is across the beam: pointing and footprint.
  Eigen::Matrix3d pointingCovariance(const ScanGeometry& geometry) const;
};

}  // namespace pcl_als
