// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/common/raster.h>

namespace pcl_als::detail {

/// Slope (degrees) and roughness (RMS of the residuals in height, metres) of the plane by least
/// squares through the heights within \a radius cells; NaN where fewer than half of the square's
/// cells, or none in the middle, have one.
void slopeAndRoughness(const RasterGrid& grid, const std::vector<float>& heights, int radius,
                       std::vector<float>& slope, std::vector<float>& roughness);

}  // namespace pcl_als::detail
