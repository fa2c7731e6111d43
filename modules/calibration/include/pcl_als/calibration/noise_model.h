// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {

/** \brief Random errors of one return, without systematic effects.
 *
 * The covariance of a ground point is built in the frame of its pulse: range noise along the beam,
 * pointing noise times range across it, the contribution of the footprint where the surface is not
 * perpendicular to the beam, and the short-term noise of the trajectory in all directions. Errors
 * that the points of a strip share (slow trajectory errors) belong to SharedErrorModel.
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
  /// Standard deviation of the place within the footprint that a return comes from, rad.
  double footprint() const { return 0.25 * beam_divergence; }
  /// The part of it across the beam: pointing and footprint.
  Eigen::Matrix3d pointingCovariance(const ScanGeometry& geometry) const;
};

/** \brief Variance of n'e, the error of the normal distance of a pair (m^2): its weight is P_w =
 * sigma_0^2 / (n' Sigma n).
 *
 * The paper keeps the (w,w) entry of P = sigma_0^2 Sigma^-1, which is the precision of e along n
 * *given* its in-plane part. The matrix D, however, makes the in-plane part unknown, and
 * eliminating it leaves the marginal precision 1 / (n' Sigma n). Both agree when n is a principal
 * axis of Sigma. Otherwise (pointing noise far larger than range noise, 20 degrees of incidence)
 * the (w,w) entry gives a pair several times too much weight.
 */
double normalVariance(const Eigen::Matrix3d& covariance, const Eigen::Vector3d& normal);

}  // namespace pcl_als
