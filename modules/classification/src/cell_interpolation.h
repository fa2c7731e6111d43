// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/classification/surface_rasters.h>

namespace pcl_als::detail {

/// Values at places, at most one place per cell; the value of bands is NaN-free.
struct CellSamples {
  std::vector<std::size_t> cell;
  std::vector<Eigen::Vector2d> place;      ///< metres from the grid's north-western corner
  std::vector<std::vector<float>> values;  ///< [band][sample]
};

/// Bands on the grid: the samples' values in their cells, interpolated ones in cells within reach,
/// else NaN.
struct FilledCells {
  std::vector<std::vector<float>> bands;
  std::vector<CellSource> source;
};

/// Linear in the Delaunay triangles whose circumscribed circle has at most \a radius (metres).
/// A circle of that size around a cell's centre holds all that its value depends on, twice over, so
/// tiles with a margin of 2 radius agree.
FilledCells fillByTin(const RasterGrid& grid, const CellSamples& samples, double radius);

/// Inverse squared distance from the nearest samples: rings of cells are added until they hold 8,
/// up to \a radius (metres).
FilledCells fillByDistance(const RasterGrid& grid, const CellSamples& samples, double radius);

}  // namespace pcl_als::detail
