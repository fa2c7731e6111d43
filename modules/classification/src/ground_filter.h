// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include <pcl_als/common/raster.h>

namespace pcl_als::detail {

/// The lowest return of a raster's cell; metres about any common height.
struct LowestReturn {
  int column = 0, row = 0;
  float z = 0.0F;
};

/** \brief Which returns are ground, by pcl::ApproximateProgressiveMorphologicalFilter (Zhang et al.
 * 2003): openings of the lowest heights with windows up to \a largest_object metres.
 *
 * Its cells are whole numbers of the raster's, 1 m at least, and lie alike in all rasters whose
 * edges are whole cells apart. \return indices, ascending
 */
std::vector<std::size_t> groundReturns(const RasterGrid& grid,
                                       const std::vector<LowestReturn>& returns,
                                       double largest_object);

/// Metres around a return within which others decide whether it is ground.
double groundFilterReach(double cell, double largest_object);

}  // namespace pcl_als::detail
