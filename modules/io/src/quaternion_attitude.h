// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>

#include <Eigen/Core>

namespace pcl_als::detail {

/// The norm of a quaternion of a file may differ from one by as much: more than rounding to two
/// decimals does (0.01), less than other quantities in these columns.
constexpr double kQuaternionTolerance = 0.1;

/** \brief The angles of a rotation: roll, pitch and yaw, radians, of R = Rz(yaw) Ry(pitch)
 * Rx(roll).
 *
 * Roll is in (-pi, pi], pitch in [-pi/2, pi/2], yaw in [0, 2 pi). A quaternion and its negative are
 * one rotation.
 *
 * \param wxyz w, x, y, z with R v = q v q*; it is normalised. Nothing where its norm is not one.
 */
std::optional<Eigen::Vector3d> anglesOfQuaternion(const Eigen::Vector4d& wxyz);

}  // namespace pcl_als::detail
