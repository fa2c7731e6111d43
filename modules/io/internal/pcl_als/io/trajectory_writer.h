// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/io/trajectory_accuracy.h>
#include <pcl_als/io/trajectory_io.h>

namespace pcl_als {

/** \brief Writes a trajectory as CSV: time,x,y,z, roll,pitch,heading where every sample has them,
 * and sd_east,sd_north,sd_up,sd_roll,sd_pitch,sd_heading where \a accuracy has one for every
 * sample; seconds, metres, degrees.
 *
 * A standard deviation that is not known is an empty field. A further column "reconstructed" marks
 * trajectories that were found from points.
 */
void writeTrajectoryCsv(const std::filesystem::path& path,
                        const std::vector<TrajectorySample>& samples,
                        const std::vector<TrajectoryAccuracy>& accuracy = {},
                        bool reconstructed = false);

/** \brief Writes a trajectory as an Applanix SBET: WGS 84 (ITRF), radians, wander angle zero.
 *
 * Velocities (north, west, up) are differences of the positions; accelerations and angular rates
 * are zero. Standard deviations have no place in the format: writeAccuracies().
 *
 * \param crs of the samples. InputError where a sample has no attitude, and as for MapProjection
 */
void writeSbet(const std::filesystem::path& path, const std::vector<TrajectorySample>& samples,
               const std::string& crs);

}  // namespace pcl_als
