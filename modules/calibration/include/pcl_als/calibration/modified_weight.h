// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

namespace pcl_als {

/** \brief The modified weight matrix of a point-patch pair, P' = M' diag(0, 0, P_w) M = P_w n n'
 * (Eqs. (31)-(33)).
 *
 * M is a rotation whose third row is the patch's unit normal n. P' D = 0 for every D in the patch's
 * plane (Eq. (34)), which is how the unknown offset between pseudo-conjugate points leaves the
 * adjustment.
 *
 * \param weight P (3 x 3, symmetric), \param normal unit. \return P' (3 x 3, rank one).
 */
Eigen::Matrix3d modifiedWeight(const Eigen::Matrix3d& weight, const Eigen::Vector3d& normal);

/** \brief Variance of the one number a pair contributes, n'e (m^2): its weight is P_w = sigma_0^2 /
 * (n' Sigma n).
 *
 * The paper keeps the (w,w) entry of P = sigma_0^2 Sigma^-1. That is the precision of e along n
 * *given* its in-plane part; D makes the in-plane part unknown, and eliminating it leaves the
 * marginal precision 1 / (n' Sigma n). Both agree when n is a principal axis of Sigma. Where it is
 * not (pointing noise far larger than range noise, seen at 20 degrees of incidence) the (w,w) entry
 * trusts a pair several times too much.
 */
double normalVariance(const Eigen::Matrix3d& covariance, const Eigen::Vector3d& normal);

/// A rotation (3 x 3, ground to patch frame u v w) whose third row is \a normal.
Eigen::Matrix3d patchRotation(const Eigen::Vector3d& normal);

}  // namespace pcl_als
