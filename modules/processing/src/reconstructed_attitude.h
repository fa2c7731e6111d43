// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/progress.h>
#include <pcl_als/processing/trajectory_from_points.h>

namespace pcl_als::detail {

/** \brief Roll, pitch and heading of a reconstructed flight, with their standard deviations.
 *
 * Pitch and crab are those of AttitudeRecovery, in a further reading of the points; the heading is
 * the course less the crab. The roll is that of the middle of the swath, whose edges must be
 * complete. Without any of these the samples have no attitude; ReconstructedTrajectory::attitude
 * states the reason.
 */
void recoverAttitude(const SurveyReader& survey, ReconstructedTrajectory& flight,
                     ProgressReport& progress);

}  // namespace pcl_als::detail
