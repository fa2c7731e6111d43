// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

namespace pcl_als {

/** \brief The modified weight matrix of a point-patch pair, P' = M' diag(0, 0, P_w) M = P_w n n'
 * (Eqs. (31)-(33)).
 *
 * M is a rotation whose third row is the unit normal n of the patch. P' D = 0 for every D in the
 * plane of the patch (Eq. (34)): the unknown offset between pseudo-conjugate points has no weight.
 *
 * \param weight P (3 x 3, symmetric), \param normal unit. \return P' (3 x 3, rank one).
 */
Eigen::Matrix3d modifiedWeight(const Eigen::Matrix3d& weight, const Eigen::Vector3d& normal);

/// A rotation (3 x 3, ground to patch frame u v w) whose third row is \a normal.
Eigen::Matrix3d patchRotation(const Eigen::Vector3d& normal);

}  // namespace pcl_als
