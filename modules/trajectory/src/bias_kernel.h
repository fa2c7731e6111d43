// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/bias_evaluator.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als::detail {

/// Biases in the form that the kernel needs.
struct MountingBias {
  explicit MountingBias(const SystemVector& biases);

  SystemVector all;
  Eigen::Vector3d lever_arm;  ///< metres
  Eigen::Matrix3d boresight;  ///< B of corrected()
  double range = 0.0, scale = 0.0;
};

/** \brief point - corrected(pose, point, biases) for points whose times are all in one span.
 *
 * Zero biases give exactly zero. Points must not be the sensor's own position.
 */
void biasKernel(const FlightSpan& span, const MountingBias& bias, const PointColumns& points,
                std::size_t count, const EffectColumns& effect);

}  // namespace pcl_als::detail
