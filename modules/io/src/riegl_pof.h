// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "trajectory_records.h"

namespace pcl_als::detail {

/** \brief Reads a RIEGL position and orientation file (.pof).
 *
 * Layout as published by the reader pos-rs (P. Gadomski, crate pos 0.2): a header with version,
 * offset of the records, date, number of records, unit and system of the times; records of 7 or
 * (from version 1.1 on) 8 little-endian doubles: time, longitude, latitude, height, roll, pitch,
 * yaw (s, degrees, m), distance. Seconds of the day become seconds of the week by the date, UTC
 * becomes GPS time. Standard deviations are those of the .poq of the same name, if there is one.
 *
 * InputError names file and record.
 */
TrajectoryRecords readRieglTrajectory(const std::filesystem::path& path,
                                      const TrajectoryReading& reading);

/// Whether the bytes are those of a RIEGL accuracy file (.poq) by their beginning.
bool isRieglAccuracy(const std::string& content);

/** \brief Reads the standard deviations of a RIEGL trajectory (.poq).
 *
 * A header with version, offset of the records and statistics of the time steps; records of time,
 * standard deviations of north, east, down (m), roll, pitch, yaw (degrees), PDOP, and one or (from
 * version 1.1 on) two numbers of satellites. The times are those of the .pof of the same name;
 * without it they are taken as they stand.
 */
std::vector<TrajectoryAccuracy> readRieglAccuracies(const std::filesystem::path& path);

}  // namespace pcl_als::detail
