// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace pcl_als {

/** \brief Where the cells of a raster lie: square cells, rows from north to south, columns from
 * west to east.
 *
 * Cell (0, 0) is the north-western one; west and north are its outer edges. A place on the edge
 * between two cells belongs to the eastern and to the southern one.
 */
struct RasterGrid {
  double west = 0.0, north = 0.0;  ///< metres, ground frame: outer edges
  double cell = 1.0;               ///< side of a cell, metres, > 0
  int columns = 0, rows = 0;
  std::string crs;  ///< WKT or "EPSG:…"; empty when unknown. It may count in another unit: a file
                    ///< of the raster is georeferenced in that unit, places here are metres

  /// The smallest grid that holds the box; its edges are multiples of the cell size, so that grids
  /// of one cell size fit together. UsageError for a cell size or box that gives no usable grid.
  static RasterGrid covering(double min_x, double min_y, double max_x, double max_y, double cell,
                             std::string crs = {});

  double east() const { return west + columns * cell; }
  double south() const { return north - rows * cell; }
  double centreX(int column) const { return west + (column + 0.5) * cell; }
  double centreY(int row) const { return north - (row + 0.5) * cell; }
  /// Column and row of a place; outside of [0, columns) and [0, rows) beside the raster.
  long long columnOf(double x) const { return std::llround(std::floor((x - west) / cell)); }
  long long rowOf(double y) const { return std::llround(std::floor((north - y) / cell)); }
  bool holds(long long column, long long row) const {
    return column >= 0 && column < columns && row >= 0 && row < rows;
  }
  std::size_t cells() const { return static_cast<std::size_t>(columns) * rows; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * columns + column;
  }
  /// Whether both have the same cells; the CRS is not compared.
  bool sameCells(const RasterGrid& other) const;
};

/// A rectangle of cells.
struct RasterWindow {
  int column = 0, row = 0, columns = 0, rows = 0;
  std::size_t cells() const { return static_cast<std::size_t>(columns) * rows; }
};

/// One value per cell, row by row from the north-western cell; NaN where there is none.
struct RasterBand {
  static constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();

  std::string name;
  std::vector<float> values;
};

/// Bands on one grid, in memory.
struct Raster {
  RasterGrid grid;
  std::vector<RasterBand> bands;

  /// The band of that name; UsageError, naming those there are, when there is none.
  const RasterBand& band(const std::string& name) const;
  /// A new last band without values.
  RasterBand& addBand(const std::string& name);
};

/// What a cell value of a map of classes means and how it is drawn.
struct CodeMeaning {
  std::uint8_t value = 0;
  std::string name;
  std::array<std::uint8_t, 3> colour{};  ///< red, green, blue
};

/// A map of classes: one byte per cell, row by row from the north-western cell.
struct CodeRaster {
  static constexpr std::uint8_t kNoClass = 0;

  RasterGrid grid;
  std::vector<std::uint8_t> values;
  std::vector<CodeMeaning> legend;
};

}  // namespace pcl_als
