// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/common/bias_prior.h>
#include <pcl_als/common/calibration_result.h>

#include "parameter_choice.h"

namespace pcl_als {

/** \brief What a prior and the observations say of each parameter of which both say something, the
 * largest difference (by its standard deviation) first.
 *
 * With the prior (mean m, information L, covariance P = L^-1), the covariance C = (N + L)^-1 of the
 * solution x, and the part Q of its covariance that stems from the observations, x - m has the
 * covariance D = (C L - I) P (C L - I)' + Q. If the value of parameter i has changed by b since the
 * prior, the expectation of s = L (x - m) is R e_i b with R = L - L C L, so that b = s_i / R_ii,
 * with the standard deviation sqrt((L D L)_ii) / R_ii. Significant are those of these that the
 * normal distribution exceeds with 1 % for all parameters together (Bonferroni).
 */
std::vector<PriorDifference> priorDifferences(const BiasPrior& prior,
                                              const ParameterChoice& choice);

/// Shares of the prior in the variances of the estimates, the prior, its differences to the
/// observations, and a warning for each that is significant. \a released: of parameters of which
/// the prior is not used any more.
void reportPrior(const BiasPrior& prior, const ParameterChoice& choice,
                 const std::vector<PriorDifference>& released, CalibrationResult& result);

}  // namespace pcl_als
