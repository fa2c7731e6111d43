// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>

#include "adjustment.h"

namespace pcl_als {

/// An adjustment by areas, with its last normal equations.
struct AreaAdjustment {
  const Adjustment& whole;
  std::vector<std::size_t> pairs;       ///< by area
  std::vector<Eigen::Vector2d> places;  ///< centres of the areas, metres
  std::vector<SystemParameter> estimate;
};

/// A parameter that differs between two halves of a block.
struct PartDifference {
  SystemParameter parameter;
  std::string halves;       ///< "the western and the eastern half"
  double difference = 0.0;  ///< second minus first, internal units
  double std = 0.0;         ///< of the difference, from both standard deviations
};

/** \brief Parameters that differ between halves of a block by more than their standard deviations
 * explain.
 *
 * The block is halved at the median of its pairs, from west to east and from south to north, and
 * each half is adjusted alone with the normal equations and variance components of the block.
 * A bias of the system is the same everywhere; deformations of the strips and errors of the scanner
 * that the model does not contain are not. The standard deviation of the difference takes the
 * halves as independent; trajectory errors that they share make the comparison conservative. A
 * parameter that either half determines much worse than the block is not compared.
 *
 * Of each parameter the larger of the two significant differences (3.3 standard deviations, 1 % for
 * all comparisons of a block together) is returned.
 */
std::vector<PartDifference> partDifferences(const AreaAdjustment& adjustment);

/// Adds the differences to a result: the variance between halves that their standard deviations do
/// not explain is added to that of the parameter, with a reason and a warning.
void judgeParts(const std::vector<PartDifference>& differences, CalibrationResult& result);

}  // namespace pcl_als
