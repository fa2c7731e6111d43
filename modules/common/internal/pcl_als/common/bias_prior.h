// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/recovered_attitude.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/// What is known of the biases before a calibration: normally distributed; internal units.
struct BiasPrior {
  SystemVector mean = SystemVector::Zero();
  /// Inverse of the covariance of the known parameters; rows and columns of zeros for the others,
  /// of which nothing is known.
  SystemMatrix information = SystemMatrix::Zero();
  std::string source;  ///< the file that it is from; empty: stated
  /// Of the calibration that it is from; none: not known.
  std::optional<AttitudeSource> attitude;
  /// From other missions: a parameter may have changed since, beyond what the covariance allows
  /// for. The prior of one that the observations contradict is not used.
  bool of_other_missions = false;

  bool any() const { return information.diagonal().maxCoeff() > 0.0; }
  bool of(SystemParameter p) const { return information(indexOf(p), indexOf(p)) > 0.0; }
  /// The known parameters, in their order.
  std::vector<SystemParameter> known() const;
  /// Of the known parameters; zero for the others.
  SystemMatrix covariance() const;
  /// What it says of these parameters alone: with the covariance P of all, the inverse of the rows
  /// and columns of P that belong to them, computed as the Schur complement of the information.
  BiasPrior marginal(const std::vector<SystemParameter>& parameters) const;
  /// What it says of the other parameters.
  BiasPrior without(SystemParameter parameter) const;

  /// Biases with the means of the known parameters in the place of these.
  SystemVector replacing(SystemVector biases) const;

  /// The prior of independent parameters: adds one, internal units.
  void add(SystemParameter parameter, double value, double std);
};

/// The normal distribution of these parameters with a covariance matrix (internal units, in that
/// order). InputError where the matrix is not positive definite.
BiasPrior biasPrior(const std::vector<SystemParameter>& parameters, const SystemVector& mean,
                    const Eigen::MatrixXd& covariance);

/** \brief Standard deviations of the change of each parameter from one mission to another with the
 * same mounting, internal units: 5" roll and pitch, 10" heading, 5 mm lever arms and range, 1e-5 of
 * the scan angle.
 *
 * An assumption: publications and data sheets state the precision of single calibrations, which
 * includes their own errors. The values are of the size of that precision (5" move a point by 24 mm
 * at 1000 m), so that a flight that determines a parameter well is hardly bound by earlier ones. A
 * history of calibrations of the same system replaces them.
 */
SystemVector missionChangeStd();

}  // namespace pcl_als
