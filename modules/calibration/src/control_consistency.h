// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/** \brief Whether control points agree with each other within their standard deviations.
 *
 * Scatter: the median absolute deviation of the residuals over their expected standard deviations;
 * 1 where control is as good as stated.
 *
 * Two groups: the split of the residuals that separates two means best. A normal distribution split
 * at its median has means 2.7 of the groups' own standard deviations apart, a uniform one 3.5; two
 * groups are reported from 4.5 on, where the smaller one holds a fifth of the points and the
 * distance is five expected standard deviations. Which of them is right cannot be determined.
 */
struct ControlConsistency {
  double scatter = 1.0;
  double rms = 0.0;         ///< metres, of the residuals of the points that were used
  bool two_groups = false;  ///< the other members below are set
  double separation = 0.0;  ///< metres, between the groups' means
  std::vector<std::string> higher, lower;  ///< ids, by the height of the strips above the points

  explicit ControlConsistency(const std::vector<ControlPointFit>& points);
};

/// Adds to a result what its control points show: warnings that name rejected points and say where
/// control is worse than stated; for two groups an objection to the verdict, and the standard
/// deviation of range_bias that allows for either group.
void judgeControl(CalibrationResult& result);

}  // namespace pcl_als
