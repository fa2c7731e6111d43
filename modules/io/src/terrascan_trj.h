// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>

#include "trajectory_records.h"

namespace pcl_als::detail {

/** \brief TerraScan trajectory (.trj), as described in the TerraScan User's Guide.
 *
 * Little-endian. Header: "TSCANTRJ", version, size of the header, number and size of the records
 * (32-bit integers), and further fields that are not used. Records: time (s), easting, northing,
 * elevation, heading, roll, pitch (degrees; doubles), and quality marks, which are not read because
 * their steps are not documented. Map coordinates, heading from grid north.
 */
TrajectoryRecords readTerrascanTrajectory(const std::filesystem::path& path,
                                          const TrajectoryReading& reading);

}  // namespace pcl_als::detail
