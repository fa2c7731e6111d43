// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/calibration/pair_observation.h>
#include <pcl_als/calibration/parameter_choice.h>
#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// Puts what the calibration found into a CalibrationResult, with a warning for all that a user
/// must know.
class CalibrationReport {
 public:
  CalibrationReport(const std::vector<std::string>& strip_ids, bool without_control);

  /// Fit of pairs and control under \a biases; \a after selects which half of PairFit and
  /// ControlFit is filled.
  void addFit(const std::vector<AreaObservations>& observations, const SystemVector& biases,
              bool after, CalibrationResult& result) const;

  /// Parameters, standard deviations, correlations and statuses; \a requested is empty for
  /// automatic choice.
  void addParameters(const ParameterChoice& choice, const std::vector<SystemParameter>& requested,
                     CalibrationResult& result) const;

  /// Every control point that a strip sees, from all pairs of the control areas found anew with the
  /// widest threshold. \a used: by area, whether the adjustment gave a pair of it a weight.
  void addControlPoints(const std::vector<ControlPoint>& control,
                        const std::vector<AreaObservations>& observations,
                        const std::vector<bool>& used, double trajectory_std,
                        CalibrationResult& result) const;

  /// The trajectory errors of each strip by the solution.
  void addStrips(const SharedErrors& errors, const std::vector<bool>& used,
                 const AdjustmentSolution& solution, CalibrationResult& result) const;
  /// Fit of pairs with these errors taken out, too.
  void addStripFit(const std::vector<AreaObservations>& observations, const Adjustment& adjustment,
                   const AdjustmentSolution& solution, CalibrationResult& result) const;

 private:
  const std::vector<std::string>& ids_;
  bool without_control_;
};

}  // namespace pcl_als
