// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/survey_types.h>

#include "pair_observation.h"
#include "pair_set.h"
#include "parameter_choice.h"

namespace pcl_als {

/// Fills a CalibrationResult and adds the warnings.
class CalibrationReport {
 public:
  CalibrationReport(const std::vector<std::string>& strip_ids, bool without_control);

  /// Fit of pairs and control for \a biases; \a after selects which values of PairFit and
  /// ControlFit are set.
  void addFit(const std::vector<AreaObservations>& observations, const SystemVector& biases,
              bool after, CalibrationResult& result) const;

  /// Parameters, standard deviations, correlations and statuses; \a requested is empty for
  /// automatic choice.
  void addParameters(const ParameterChoice& choice, const std::vector<SystemParameter>& requested,
                     CalibrationResult& result) const;

  /// Residuals of every control point that a strip covers, from all pairs of the control areas
  /// formed anew with the widest threshold. \a used: by area, what the adjustment gave a weight.
  void addControlPoints(const std::vector<ControlPoint>& control,
                        const std::vector<AreaObservations>& observations,
                        const std::vector<AreaUse>& used, double trajectory_std,
                        CalibrationResult& result) const;

  /// The estimated trajectory errors of each strip, with their standard deviations.
  void addStrips(const SharedErrors& errors, const std::vector<bool>& used,
                 const Adjustment& adjustment, const ParameterChoice& choice,
                 CalibrationResult& result) const;
  /// Fit of the pairs after removal of these errors.
  void addStripFit(const std::vector<AreaObservations>& observations, const Adjustment& adjustment,
                   const AdjustmentSolution& solution, CalibrationResult& result) const;

 private:
  const std::vector<std::string>& ids_;
  bool without_control_;
};

}  // namespace pcl_als
