// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include "block.h"

namespace pcl_als {

/// Strips of which some are excluded, with the reasons.
struct StripSelection {
  BlockStrips strips;
  std::vector<ExcludedPoints> excluded;
  Warnings warnings;
};

/** \brief Excludes strips that take part in no pair that was asked for, strips with few points,
 * copies of other strips, and strips whose times are rounded to steps in which the sensor moves by
 * more than the error of its trajectory.
 *
 * InputError where fewer than two strips have times that are precise enough.
 */
StripSelection selectStrips(const BlockStrips& strips, const BlockIndex& index,
                            const BlockRequest& request);

/// The pairs of strips that overlap and are wanted, with a warning for each that does not overlap.
/// InputError where there is nothing to compare.
std::vector<StripPair> choosePairs(const BlockStrips& strips, const SurveyMap& map,
                                   const BlockRequest& request, Warnings& warnings);

/// InputError for a reference surface that no strip overlaps, or that lies far above or below them.
void checkReferences(const BlockStrips& strips, const SurveyMap& map,
                     const CalibrationSettings& settings);

}  // namespace pcl_als
