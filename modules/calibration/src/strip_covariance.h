// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/system_parameters.h>

#include "block_cholesky.h"
#include "shared_errors.h"

namespace pcl_als {

/** \brief A posteriori covariances of the trajectory errors of strips.
 *
 * With the normal equations N of the parameters (g) and the shared errors (t), the covariance C of
 * the parameters, and E = N_tt^-1 N_tg, the errors have the covariance N_tt^-1 + E C E', and -E C
 * with the parameters. Of N_tt^-1 the entries are used at which the factor of N_tt may differ from
 * zero; they include those of every two unknowns that determine the errors at one time.
 */
class StripCovariance {
 public:
  /// \param inverse of N_tt
  /// \param elimination E, a row for each unknown
  /// \param parameters C; m, rad, 1
  StripCovariance(const SharedErrors& errors, const VarianceFactors& levels, InverseEntries inverse,
                  Eigen::Matrix<double, Eigen::Dynamic, kSystemParameterCount> elimination,
                  const SystemMatrix& parameters);

  static constexpr int kErrors = SharedErrors::kPerKnot;
  /// Covariances at a time, m and rad.
  struct At {
    Eigen::Matrix<double, kErrors, kErrors> errors;
    Eigen::Matrix<double, kErrors, kSystemParameterCount> parameters;
  };
  At at(int strip, const SharedErrors::Expectation& expectation) const;

  /// Sets the standard deviations of the knots (at the times of SharedErrors::expectationsOf()) and
  /// the correlations with each other and with the parameters \a order, at some of the knots.
  void add(int strip, const std::vector<SystemParameter>& order, StripErrors& result) const;

 private:
  const SharedErrors& errors_;
  VarianceFactors levels_;
  InverseEntries inverse_;
  Eigen::Matrix<double, Eigen::Dynamic, kSystemParameterCount> elimination_;
  SystemMatrix parameters_;
};

}  // namespace pcl_als
