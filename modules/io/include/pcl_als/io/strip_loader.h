// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <vector>

#include <pcl_als/common/strip.h>

namespace pcl_als {

/** \brief Reads point files (.las, .laz, .pcd) whole and sorts their points into strips.
 *
 * Strips are separated and named by StripNaming and returned in its order; points keep file order.
 * A strip that reaches further than LocalFrame::kReach from its centre comes as several parts with
 * the same id, cut by a grid of 5 km, each relative to the centre of its square. Memory: 48 bytes
 * per point. Files are read twice.
 *
 * InputError when files declare different kinds of GPS time or CRS that do not agree
 * (commonReference()). Coordinates are in metres, whatever unit the files count in.
 */
std::vector<Strip<PointLidar>> loadStrips(const std::vector<std::filesystem::path>& files);

}  // namespace pcl_als
