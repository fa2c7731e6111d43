// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace pcl_als {

struct RasterGrid;
struct SeparationSummary;
class SwathSeparation;

/// The grid of an image: \a cell metres, doubled until it fits into memory. \a covered_area: m^2 of
/// all strips, summed.
RasterGrid separationGrid(const Eigen::AlignedBox2d& extent, double covered_area, double cell,
                          const std::string& crs);

/** \brief Writes STEM.tif (red, green, blue), STEM_metres.tif (the separation) and STEM.png.
 *
 * A PNG is limited to 64 million pixels: larger images show every second, third, … cell.
 */
SeparationSummary writeSeparation(const std::filesystem::path& folder, const std::string& stem,
                                  const SwathSeparation& separation, int quality_level,
                                  int threads);

}  // namespace pcl_als
