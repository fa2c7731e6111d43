// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>

#include "trajectory_records.h"

namespace pcl_als::detail {

/** \brief Applanix "smoothed best estimate of trajectory".
 *
 * Records of 17 little-endian doubles: time (s of week), latitude, longitude (rad), ellipsoidal
 * height (m), three velocities, roll, pitch, platform heading, wander angle (rad), three
 * accelerations, three angular rates. True heading = platform heading - wander angle.
 */
TrajectoryRecords readSbet(const std::filesystem::path& path, const TrajectoryReading& reading);

}  // namespace pcl_als::detail
