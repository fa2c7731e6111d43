// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// False for points that no check uses: withheld, noise (7, 18), not finite.
bool isCheckable(const LidarReturn& point);

/// True for a checkable point that may be part of a solid surface: a last return, not on water (9).
/// Vegetation is removed by dropHighVegetation().
bool isSolid(const LidarReturn& point);

/** \brief Removes the points of one strip that are classified as vegetation (3-5) and more than one
 * metre above the lowest point of their cell of 5 m.
 *
 * Vegetation nearer to the ground is kept: many classifications assign to vegetation all points
 * some centimetres or decimetres above a ground that was determined from all strips together.
 * Without these, the low points of every strip would remain, and the higher strip would appear
 * lower.
 */
void dropHighVegetation(std::vector<LidarReturn>& points);

}  // namespace pcl_als
