// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/planning/block_advice.h>

namespace pcl_als {

/// Expected result of a planned flight.
struct FlightPlanResult {
  std::vector<StripGeometry> lines;
  struct Overlap {
    std::string a, b;
    std::size_t areas = 0;  ///< areas in which the two are compared
    double pairs = 0.0;     ///< expected point-to-patch pairs
  };
  std::vector<Overlap> overlaps;
  std::size_t control_points = 0;  ///< control points covered by a line
  /// Standard deviations, correlations, statuses and reasons in the form of a calibration result;
  /// biases are zero, converged states whether all requested parameters are determined.
  CalibrationResult expected;
  ObservabilityReport observability;
};

/** \brief Predicts the standard deviations that a calibration flight will give.
 *
 * Pairs are synthesised in the overlaps of the planned lines and are processed by the same
 * adjustment, shared errors and choice of parameters as measured ones.
 */
class FlightPlan {
 public:
  struct Settings {
    ObservabilitySettings adjustment;  ///< with noise, surface and control sigma in pairs
    std::size_t control_points = 0;    ///< distributed over the block
  };
  /// UsageError for a line that cannot be flown, an id that appears twice or an impossible setting.
  FlightPlan(std::vector<StripGeometry> lines, const Settings& settings);

  /// InputError when no two lines overlap and there is no control.
  FlightPlanResult evaluate() const;

 private:
  ObservedBlock synthesised() const;

  std::vector<StripGeometry> lines_;
  Settings settings_;
};

}  // namespace pcl_als
