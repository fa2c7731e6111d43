// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <string>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/** \brief What one flight tells about the parameters of a system, in information form.
 *
 * With the estimate b of the estimated parameters and its covariance C, the information matrix is
 * C^-1 and the information vector C^-1 b; rows of parameters that do not matter are zero. Held
 * parameters h, whose possible size s the covariance includes by F diag(s^2) F' (HeldParameters),
 * are unknowns beside the others: b observes beta - F h with the covariance C - F diag(s^2) F'. The
 * information of a prior that the calibration used is taken out, so that combining missions does
 * not count it again. Internal units (m, rad, 1); b = assumed - true.
 */
struct CalibrationMission {
  std::string name;                          ///< the calibration file, for messages and tables
  std::optional<long> day;                   ///< date of the flight, days since 1980-01-06
  std::map<std::string, double> covariates;  ///< values such as the temperature, by name
  SystemMatrix information = SystemMatrix::Zero();
  SystemVector information_vector = SystemVector::Zero();
  /// A priori standard deviations of held parameters; zero for the others.
  SystemVector held_std = SystemVector::Zero();
  /// Estimates by this flight alone and their standard deviations; NaN for parameters that the
  /// flight does not determine.
  SystemVector bias, std;

  /// A priori standard deviation of a parameter: that of a held one, else the largest bias that is
  /// accepted.
  double priorStd(SystemParameter p) const {
    const double held = held_std[indexOf(p)];
    return held > 0.0 ? held : largestBias(p);
  }
  bool determines(SystemParameter p) const { return std::isfinite(std[indexOf(p)]); }
};

/** \brief The mission of a calibration.
 *
 * \param system name of the system, of a calibration with several (calibrationOfSystem(), whose
 * UsageError is thrown with \a name).
 *
 * InputError, with \a name, where the calibration has no estimated parameter, where a standard
 * deviation is not positive, or where the correlation matrix is not positive definite.
 */
CalibrationMission missionOf(const CalibrationResult& calibration, const std::string& name,
                             const std::string& system = {});

}  // namespace pcl_als
