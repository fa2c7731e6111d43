// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <map>
#include <optional>
#include <string>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/** \brief What one flight tells about the parameters of a system, in information form.
 *
 * With the estimate b and its covariance C (rows and columns of the estimated parameters), the
 * information matrix is C^-1 and the information vector C^-1 b; rows of parameters that the flight
 * does not determine are zero. Internal units (m, rad, 1); b = assumed - true.
 */
struct CalibrationMission {
  std::string name;                          ///< the calibration file, for messages and tables
  std::optional<long> day;                   ///< date of the flight, days since 1980-01-06
  std::map<std::string, double> covariates;  ///< values such as the temperature, by name
  SystemMatrix information = SystemMatrix::Zero();
  SystemVector information_vector = SystemVector::Zero();
  /// Estimates and their standard deviations; NaN for parameters that the flight does not
  /// determine.
  SystemVector bias, std;

  bool determines(SystemParameter p) const { return information(indexOf(p), indexOf(p)) > 0.0; }
};

/** \brief The mission of a calibration.
 *
 * \param system name of one of several systems of the calibration; empty: the only or the first
 * one. The correlations of a system other than the first are not stored and are taken as zero.
 *
 * InputError, with \a name, where the calibration has no estimated parameter, where a standard
 * deviation is not positive, where the correlation matrix is not positive definite, or where no
 * system has that name.
 */
CalibrationMission missionOf(const CalibrationResult& calibration, const std::string& name,
                             const std::string& system = {});

/// A date such as "2026-05-04" of a day since 1980-01-06.
std::string dateText(long day);

}  // namespace pcl_als
