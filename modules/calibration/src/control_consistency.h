// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/control_groups.h>

#include "adjustment.h"

namespace pcl_als {

/** \brief Whether control points agree within their standard deviations.
 *
 * Scatter: the median absolute deviation of the residuals over their expected standard deviations;
 * 1 where control is as accurate as stated.
 */
struct ControlConsistency {
  double scatter = 1.0;
  double rms = 0.0;  ///< metres, of the residuals of the points that were used
  /// The same of the east and north coordinates of targets, which take no part in the groups.
  double plan_scatter = 1.0, plan_rms = 0.0;
  std::optional<ControlGroups> groups;  ///< of points that contradict each other

  explicit ControlConsistency(const std::vector<ControlPointFit>& points);
};

/// An adjustment with control.
struct ControlledAdjustment {
  const SharedErrors& errors;
  VarianceFactors levels;
  const std::vector<AreaObservations>& observations;
  const std::vector<std::vector<double>>& weights;
  std::size_t first_control = 0;     ///< the area of the first control point; the others follow
  std::vector<std::string> control;  ///< ids
  std::vector<SystemParameter> estimate;
  int threads = 0;
};

/** \brief Change of each parameter if one or the other of two groups of control is correct.
 *
 * The adjustment is solved with the heights of the one group, then of the other, moved by the
 * separation of the groups, with the same observations and weights. The larger of the two changes
 * is returned (internal units; zero without two groups).
 */
SystemVector controlSpread(const ControlConsistency& control,
                           const ControlledAdjustment& adjustment);

/// Adds the assessment of control to a result: warnings that name rejected points and state where
/// control is less accurate than given; for two groups an objection in the verdict, and standard
/// deviations that include both groups, from controlSpread().
void judgeControl(const ControlConsistency& control, const SystemVector& spread,
                  CalibrationResult& result);

}  // namespace pcl_als
