// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_als {

/** \brief A rigid body motion (with an optional scale) about a point:
 * target = centroid + shift + scale R (source - centroid), R = Rx(omega) Ry(phi) Rz(kappa).
 *
 * Right-handed rotations about east, north and up, radians; metres. About a point inside the data,
 * shift and rotations can be interpreted separately; in a matrix at UTM coordinates 0.001 degree
 * corresponds to 90 m of translation.
 */
struct RigidMotion {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< in the source's coordinates
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     ///< XT, YT, ZT: displacement of the centroid
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< omega, phi, kappa; |phi| < pi / 2
  double scale = 1.0;

  Eigen::Matrix3d rotationMatrix() const;
  Eigen::Vector3d apply(const Eigen::Vector3d& source) const;
  /// The inverse motion, about the displaced centroid.
  RigidMotion inverse() const;

  /** \brief The same as a 4 x 4 matrix from coordinates relative to one origin to coordinates
   * relative to another (both metres, in the frame of the centroid). */
  Eigen::Affine3d transformation(
      const Eigen::Vector3d& source_origin = Eigen::Vector3d::Zero(),
      const Eigen::Vector3d& target_origin = Eigen::Vector3d::Zero()) const;

  /// The motion about \a centroid that equals a transformation (rotation times a positive scale,
  /// and a translation).
  static RigidMotion about(const Eigen::Vector3d& centroid, const Eigen::Affine3d& transformation);

  /// d(omega, phi, kappa) / d(theta), 3 x 3, of a small rotation theta that follows:
  /// Exp(theta) R.
  Eigen::Matrix3d anglesFromTurn() const;
};

}  // namespace pcl_als
