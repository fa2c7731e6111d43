// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/** \brief Position of a ground point in the frame of the laser unit at emission (right-forward-up).
 *
 * Without attitude the system is assumed to be vertical, as in Habib et al. 2011: x is the signed
 * lateral distance from the local flight line in plan, z the elevation of the point minus that of
 * the firing point, y is neglected. With attitude all three are those of the body frame. In both
 * cases beta = -atan2(x, -z), so that x > 0 has beta < 0, as Eq. (2) requires. Where the trajectory
 * has several scan planes, beta is the angle in the one that contains the pulse.
 */
struct ScanGeometry {
  double x = 0.0, y = 0.0, z = 0.0;  ///< metres; right, forward, up
  double beta = 0.0;                 ///< radians, in the scan plane from its lowest direction
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();       ///< of the scan plane, body frame
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< body to ground

  Eigen::Vector3d inBody() const { return {x, y, z}; }
  /// Derivative of inBody() with respect to beta: (z, 0, -x) where the plane is across the body.
  Eigen::Vector3d turned() const { return normal.cross(inBody()); }
  double range() const { return inBody().norm(); }
  /// Unit vector of the pulse, ground frame; straight down for a point at the sensor.
  Eigen::Vector3d beam() const;
};

using DesignBlock = Eigen::Matrix<double, 3, kSystemParameterCount>;

ScanGeometry scanGeometry(const SensorPose& pose, const Eigen::Vector3d& ground_point);

/** \brief A of Habib et al. 2011, Eq. (8): effect of small biases (assumed - true) on the ground
 * coordinates.
 *
 * Rows: east, north, up (m). Columns: SystemParameter, internal units (m, rad, 1), at S = 1. With
 * attitude, its full rotation in place of Rz(kappa), and y where Eq. (8) has zero; the column of
 * the scan angle scale is beta times ScanGeometry::turned().
 */
DesignBlock designBlock(const ScanGeometry& geometry);

/** \brief Removes biases from a point: Eq. (13), not linearised, X - R (p - u).
 *
 * p is the point in the body frame, p = dP + B w, B = Rz(dkappa) Rx(domega) Ry(dphi); u is w with
 * its length reduced by dr and beta divided by 1 + dS. To first order in the biases that is X - A
 * delta; the second order of 0.5 degrees at 1000 m is 8 cm.
 */
Eigen::Vector3d corrected(const SensorPose& pose, const Eigen::Vector3d& ground_point,
                          const SystemVector& biases);

/// B = Rz(dkappa) Rx(domega) Ry(dphi) of boresight biases.
Eigen::Matrix3d boresightRotation(const SystemVector& biases);

}  // namespace pcl_als
