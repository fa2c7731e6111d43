// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/bias_prior.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/// Rows and columns of the chosen parameters.
Eigen::MatrixXd sub(const SystemMatrix& matrix, const std::vector<SystemParameter>& chosen);

/// The inverse of sub(): zero for the other parameters.
SystemMatrix expanded(const Eigen::MatrixXd& part, const std::vector<SystemParameter>& chosen);

/// What is to be added to normal equations that contain a prior of all parameters, so that they
/// contain what it says of the chosen ones alone: others are held, at values that it does not
/// expect. Exactly zero for the chosen ones where the prior of these does not depend on others.
struct PriorChange {
  SystemMatrix normal;
  SystemVector right;

  PriorChange(const BiasPrior& prior, const std::vector<SystemParameter>& chosen);
};

/// Standard deviations of the biases of an uncalibrated system, of which nothing is known: half a
/// degree, metres.
SystemVector widePriorStd();

/// Inverse of a symmetric matrix whose parameters have different units, and the logarithm of its
/// determinant; false when it is numerically singular.
bool invert(const Eigen::MatrixXd& matrix, Eigen::MatrixXd& inverse, double& log_determinant);

}  // namespace pcl_als
