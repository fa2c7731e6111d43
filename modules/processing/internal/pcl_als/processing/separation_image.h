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
class SwathSeparation;

/// A reduced swath separation image: at every place the most frequent colour of the cells that two
/// strips cover.
struct SeparationOverview {
  enum Code : std::uint8_t { nothing, one_strip, within_limit, within_twice, beyond };
  int columns = 0, rows = 0;
  double cell = 0.0;                                     ///< metres
  Eigen::Vector2d north_west = Eigen::Vector2d::Zero();  ///< metres, ground frame
  std::vector<std::uint8_t> codes;                       ///< row by row from the north-west
};

/// Numbers of cells of a swath separation image by colour, and its georeference.
struct SeparationSummary {
  double cell = 0.0;   ///< metres
  double limit = 0.0;  ///< metres: green up to it, yellow up to twice as much
  std::uint64_t green = 0, yellow = 0, red = 0;
  std::vector<std::string> files;
  SeparationOverview overview;
};

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
