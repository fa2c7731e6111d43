// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/history/calibration_history.h>

namespace pcl_als::detail {

/// One unknown of the model: parameter p of mission m is the sum over its terms of design[m] times
/// the unknown.
struct HistoryTerm {
  int parameter = 0;
  Eigen::VectorXd design;  ///< one value for each mission
  double prior_std = 0.0;  ///< of the unknown, mean zero; 0: the largest bias that is accepted
  bool lasting = true;     ///< false: of one mission only, not part of the value of the system
};

/// Information of the missions, including random changes between them.
struct MissionInformation {
  std::vector<SystemMatrix> matrix;
  std::vector<SystemVector> vector;

  std::size_t size() const { return matrix.size(); }
};

/// The missions with random changes of the given standard deviations: the covariance C of each
/// becomes C + T with T = diag(change_std^2). In information form, also for singular information:
/// L' = L - L S (I + S L S)^-1 S L with S = diag(change_std).
MissionInformation informationOf(const std::vector<CalibrationMission>& missions,
                                 const SystemVector& change_std);

/** \brief Generalised least squares over all missions. */
class HistoryModel {
 public:
  /// \param data must exist as long as this object
  HistoryModel(const MissionInformation& data, std::vector<HistoryTerm> terms);

  const std::vector<HistoryTerm>& terms() const { return terms_; }
  const Eigen::VectorXd& solution() const { return solution_; }
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  double logDeterminant() const { return log_determinant_; }  ///< of the normal matrix
  /// Sum of squares that the terms explain: solution times right-hand side.
  double explained() const { return explained_; }

  /// The parameters at mission m, by the lasting terms.
  SystemVector at(std::size_t mission) const;
  /// Their covariance.
  SystemMatrix covarianceAt(std::size_t mission) const;
  /// Information vectors of the residuals of the missions, L_m (b_m - beta(m)), of observations
  /// with the information vectors \a vectors.
  std::vector<SystemVector> residuals(const std::vector<SystemVector>& vectors) const;
  /// Variance of the score of a further term, sum over m of design[m] times
  /// residuals()[m][parameter].
  double scoreVariance(const HistoryTerm& term) const;

 private:
  Eigen::VectorXd rightSide(const std::vector<SystemVector>& vectors) const;
  SystemVector valuesAt(std::size_t mission, const Eigen::VectorXd& solution, bool all) const;

  const MissionInformation& data_;
  std::vector<HistoryTerm> terms_;
  Eigen::VectorXd solution_;
  Eigen::MatrixXd covariance_;
  double log_determinant_ = 0.0, explained_ = 0.0;
};

/// A constant for each parameter that a mission determines.
std::vector<HistoryTerm> constantTerms(const std::vector<CalibrationMission>& missions);

}  // namespace pcl_als::detail
