// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/survey_types.h>

namespace pcl_als::detail {

/** \brief The SBET half of readTrajectory(): Applanix "smoothed best estimate of trajectory".
 *
 * Records of 17 little-endian doubles: time (s of week), latitude, longitude (rad), ellipsoidal
 * height (m), three velocities, roll, pitch, platform heading, wander angle (rad), three
 * accelerations, three angular rates. True heading = platform heading - wander angle.
 */
std::vector<TrajectorySample> readSbet(const std::filesystem::path& path, const std::string& crs);

}  // namespace pcl_als::detail
