// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include <pcl_als/calibration/calibration_settings.h>

namespace pcl_als {

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
