// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_als/tin/tin.h>

#include "spatial_order.h"

namespace pcl_als::tin {

/** \brief The Delaunay triangles of distinct integer positions, by divide and conquer (Guibas and
 * Stolfi, 1985) along the quadtree of their Morton codes.
 *
 * Every cut of the quadtree is a vertical or horizontal line with one part strictly on either side,
 * so any two parts are merged as a left and a right one. Merging touches the seam only, and low
 * seams are in cache. Working memory: 84 bytes per point beside \a order.
 */
std::vector<Tin::Triangle> delaunayTriangles(const SpatialOrder& order);

}  // namespace pcl_als::tin
