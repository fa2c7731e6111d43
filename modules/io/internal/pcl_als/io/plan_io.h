// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace pcl_als {

/// A line of a flight plan as its file has it.
struct FlightLineRecord {
  std::string id;
  Eigen::Vector2d start, end;     ///< metres, any local ground frame
  double height = 0.0;            ///< metres above mean ground
  std::optional<double> speed;    ///< metres per second
  std::optional<double> density;  ///< pulses per square metre
};

/// Reads a flight plan: CSV id,x1,y1,x2,y2,height[,speed][,density], columns found by name.
/// InputError names file, line and column, also for a line of no length and an id that is not its
/// own.
std::vector<FlightLineRecord> readFlightLines(const std::filesystem::path& path);

/** \brief Elevations on a square grid, bilinear between the centres of cells.
 *
 * read() takes ESRI ASCII grids: ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter,
 * cellsize and NODATA_value in any order, then the rows from north to south. InputError for a
 * header that is incomplete or declares more than the file holds, for values that are no finite
 * numbers, too few or too many.
 */
class ElevationGrid {
 public:
  static ElevationGrid read(const std::filesystem::path& path);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  double cell() const { return cell_; }  ///< metres
  double mean() const { return mean_; }  ///< metres, of the cells that have a value
  /// Between the centres of the outermost cells, metres.
  Eigen::AlignedBox2d extent() const;

  /// Elevation (metres) and its derivatives by x and y; empty outside and beside cells without a
  /// value.
  std::optional<double> at(const Eigen::Vector2d& place, Eigen::Vector2d& gradient) const;

 private:
  double value(std::size_t column, std::size_t row) const {
    return values_[row * columns_ + column];
  }

  std::size_t columns_ = 0, rows_ = 0;
  Eigen::Vector2d first_ = Eigen::Vector2d::Zero();  ///< centre of the south-western cell, metres
  double cell_ = 1.0, mean_ = 0.0;
  std::vector<double> values_;  ///< rows from south to north; NaN: none
};

}  // namespace pcl_als
