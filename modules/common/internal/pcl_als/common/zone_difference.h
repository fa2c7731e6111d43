// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <Eigen/Core>

namespace pcl_als {

/** \brief "its eastings differ by those of a zone 6 degrees away": the text where two places of one
 * survey have the coordinates of neighbouring zones of a transverse Mercator projection, which are
 * 6 or 3 degrees wide; else empty.
 *
 * Eastings of neighbouring zones differ by the width of a zone at this latitude (to 4 %), northings
 * by less than 60 km. Latitudes follow from northings that begin at the equator.
 *
 * \param given east and north, metres \param block the same of the points
 */
std::string zoneDifference(const Eigen::Vector2d& given, const Eigen::Vector2d& block);

}  // namespace pcl_als
