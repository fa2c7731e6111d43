// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/** \brief Where a ground point lies in the laser unit's frame at its firing (right-forward-up,
 * vertical system).
 *
 * x: signed lateral distance from the local flight line in plan, right positive. z: elevation of
 * the point minus elevation of the firing point, negative below the sensor. beta = -atan2(x, -z),
 * so x > 0 has beta < 0 as Eq. (2) of Habib et al. 2011 demands.
 */
struct ScanGeometry {
  double x = 0.0, z = 0.0;  ///< metres
  double beta = 0.0;        ///< radians
  double cos_beta = 1.0, sin_beta = 0.0;
  double cos_kappa = 1.0, sin_kappa = 0.0;
};

using DesignBlock = Eigen::Matrix<double, 3, kSystemParameterCount>;

ScanGeometry scanGeometry(const FlightLine& line, const Eigen::Vector3d& ground_point);

/** \brief A of Habib et al. 2011, Eq. (8): effect of the biases (assumed - true) on the ground
 * coordinates.
 *
 * Rows: east, north, up (m). Columns: SystemParameter, internal units (m, rad, 1), at S = 1.
 */
DesignBlock designBlock(const ScanGeometry& geometry);

}  // namespace pcl_als
