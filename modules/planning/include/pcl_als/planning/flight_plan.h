// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/planning/block_advice.h>

namespace pcl_als {

/// What is to be expected of a planned flight.
struct FlightPlanResult {
  std::vector<StripGeometry> lines;
  struct Overlap {
    std::string a, b;
    std::size_t areas = 0;  ///< places in which the two are compared
    double pairs = 0.0;     ///< point-patch pairs to expect there
  };
  std::vector<Overlap> overlaps;
  std::size_t control_points = 0;  ///< those that a line sees
  /// Standard deviations, correlations, statuses and reasons as a calibration would report them;
  /// biases are zero, converged states whether all requested parameters are determined.
  CalibrationResult expected;
  ObservabilityReport observability;
};

/** \brief What a calibration flight will determine, before anyone flies it.
 *
 * Pairs are synthesised in the overlaps of the planned lines and go through the same adjustment,
 * shared errors and choice of parameters as measured ones.
 */
class FlightPlan {
 public:
  struct Settings {
    ObservabilitySettings adjustment;  ///< with noise, surface and control sigma in pairs
    std::size_t control_points = 0;    ///< spread over the block
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
