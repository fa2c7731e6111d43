// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <Eigen/Core>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/** \brief Covariance D R D of the estimated parameters, with their standard deviations D and
 * correlations R: n x n in the order of CalibrationResult::correlation_order, internal units.
 *
 * InputError, with \a name, where no parameter was estimated, where the correlations name one that
 * was not, where a standard deviation is not known, or where the correlation matrix is not positive
 * definite.
 */
Eigen::MatrixXd estimatedCovariance(const CalibrationResult& calibration, const std::string& name);

}  // namespace pcl_als
