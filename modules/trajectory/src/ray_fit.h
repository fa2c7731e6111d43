// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/adjustment/robust_iteration.h>

#include "sensor_ray.h"

namespace pcl_als::detail {

/// The place of the sensor for which the sum of its distances from rays is least, robustly: beyond
/// one standard deviation they count as absolute values. Residuals are those of returns across the
/// rays, metres.
struct RayFit : RobustFit {
  Eigen::VectorXd unknowns;  ///< place, and velocity of a moving sensor; metres, metres per second
  Eigen::MatrixXd cofactor;  ///< of the unknowns, for returns of 1 m across the rays
};

/// \param moving the sensor moves from its place at \a time
/// \return none where the rays do not determine it
std::optional<RayFit> fitRays(std::vector<SensorRay>& rays, bool moving, double time = 0.0);

/// Standard deviation of returns across, at least kLeastAcross, from residuals of two components.
double acrossOf(std::vector<double> residuals);

}  // namespace pcl_als::detail
