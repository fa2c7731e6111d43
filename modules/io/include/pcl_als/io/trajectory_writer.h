// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/io/trajectory_io.h>

namespace pcl_als {

/** \brief Writes a trajectory as CSV: time,x,y,z, roll,pitch,heading where every sample has them,
 * and sd_east,sd_north,sd_up,sd_roll,sd_pitch,sd_heading where \a accuracy has one for every
 * sample; seconds, metres, degrees.
 *
 * A standard deviation that is not known is an empty field.
 */
void writeTrajectoryCsv(const std::filesystem::path& path,
                        const std::vector<TrajectorySample>& samples,
                        const std::vector<TrajectoryAccuracy>& accuracy = {});

/** \brief Writes a trajectory as an Applanix SBET: WGS 84 (ITRF), radians, wander angle zero.
 *
 * Velocities (north, west, up) are differences of the positions; accelerations and angular rates
 * are zero. Standard deviations have no place in the format: writeAccuracies().
 *
 * \param crs of the samples. InputError where a sample has no attitude, and as for MapProjection
 */
void writeSbet(const std::filesystem::path& path, const std::vector<TrajectorySample>& samples,
               const std::string& crs);

/// Writes standard deviations as an Applanix smrmsg file (readAccuracies()); unknown ones as zero.
/// The standard deviations of velocities are zero.
void writeAccuracies(const std::filesystem::path& path,
                     const std::vector<TrajectoryAccuracy>& accuracy);

/** \brief Reads standard deviations over time from an Applanix smrmsg file.
 *
 * Records of 10 little-endian doubles: time (s, as the SBET's), standard deviations of north, east
 * and down (m), of three velocities (m/s), of roll, pitch and heading (arc-minutes). InputError
 * names file and record for values that are negative, not finite or larger than 1 km or 180
 * degrees, and for times that run backwards.
 */
std::vector<TrajectoryAccuracy> readAccuracies(const std::filesystem::path& path);

/// Standard deviations at a time, linear between records in order of time; NaN at times more than a
/// second from any record.
TrajectoryAccuracy accuracyAt(const std::vector<TrajectoryAccuracy>& accuracies, double time);

}  // namespace pcl_als
