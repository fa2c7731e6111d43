// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/large_correction.h>
#include <pcl_als/trajectory/trajectory.h>

#include "block_calibration.h"
#include "jump_search.h"
#include "pair_observation.h"

namespace pcl_als {

/// What a calibration knows that may explain a large trajectory correction.
struct CauseEvidence {
  const Trajectory& trajectory;
  const std::vector<StripTrajectory>& strips;         ///< by index
  const std::vector<AreaObservations>& observations;  ///< by area
  const std::vector<int>& pass;                       ///< StripSystems::pass; empty: each its own
  const std::optional<JumpSearch::Place>& jump;       ///< of the trajectory
};

/** \brief Adds to each correction the causes for which there is evidence, most specific first.
 *
 * | name | evidence |
 * |---|---|
 * | trajectory_gap | two neighbouring samples within 1 s of the interval are further apart than
 * three of their median distances over the strip, and than 0.1 s | | jump | JumpSearch finds a jump
 * in this strip and axis within 2 s of the interval | | whole_strip | the interval covers 80 % of
 * the strip: a constant error | | several_strips | a large correction of the same axis and sign in
 * another strip | | turn | within 3 s of the interval the course changes by more than 3 degrees per
 * second, or the body rotates faster than that and twice as fast as in the rest of the strip | |
 * strip_start, strip_end | the interval begins within 2 s of the start, or ends within 2 s of the
 * end | | single_pair | only one other strip was compared with this one in the interval |
 */
void addCauses(const CauseEvidence& evidence, std::vector<LargeCorrection>& corrections);

}  // namespace pcl_als
