// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "block.h"

namespace pcl_als {

/// InputError for a strip that begins before the trajectory or ends after it.
void checkTimes(const BlockStrips& strips, const BlockIndex& index);

/// Whether the trajectory can belong to the points: InputError where it cannot, warnings, and the
/// error of its height. May be called once.
HeightError checkTrajectory(const BlockStrips& strips, const CalibrationSettings& settings,
                            TrajectoryPlausibility& plausibility, Warnings& warnings);

/** \brief The trajectory with the attitude that is used, which is recovered from the points of all
 * strips where the trajectory has none (AttitudeRecovery).
 *
 * InputError where the attitude of a scanner that is not linear would have to be recovered.
 */
BlockTrajectory flightOf(const BlockStrips& strips, const BlockIndex& index,
                         const CalibrationSettings& settings, Warnings& warnings);

/// The pattern of the scanner by that of most strips. The planes of a scanner that has several are
/// added to the trajectory.
BlockScanner findScanner(const BlockStrips& strips, const BlockIndex& index,
                         BlockTrajectory& flight);

}  // namespace pcl_als
