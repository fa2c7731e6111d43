// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <sstream>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/raster.h>

namespace pcl_als {
namespace {

// TIFF readers count cells of a side in signed 32-bit integers; half of it leaves room for sums.
constexpr double kMostCellsOfASide = 1 << 30;

std::string text(double value) {
  std::ostringstream stream;
  stream.precision(10);
  stream << value;
  return stream.str();
}

}  // namespace

RasterGrid RasterGrid::covering(double min_x, double min_y, double max_x, double max_y, double cell,
                                std::string crs) {
  if (!(cell > 0.0) || !std::isfinite(cell))
    throw UsageError("cell size " + text(cell) + " m: must be greater than 0");
  if (!(min_x <= max_x) || !(min_y <= max_y) || !std::isfinite(max_x - min_x) ||
      !std::isfinite(max_y - min_y))
    throw UsageError("a raster needs a box whose sides are finite and not negative");
  RasterGrid grid;
  grid.cell = cell;
  grid.crs = std::move(crs);
  grid.west = std::floor(min_x / cell) * cell;
  grid.north = std::ceil(max_y / cell) * cell;
  const double columns = std::floor((max_x - grid.west) / cell) + 1.0;
  const double rows = std::floor((grid.north - min_y) / cell) + 1.0;
  if (!(columns <= kMostCellsOfASide && rows <= kMostCellsOfASide))
    throw UsageError("cell size " + text(cell) + " m: gives " + text(columns) + " x " + text(rows) +
                     " cells, too many; take larger cells");
  grid.columns = static_cast<int>(columns);
  grid.rows = static_cast<int>(rows);
  return grid;
}

bool RasterGrid::sameCells(const RasterGrid& other) const {
  return west == other.west && north == other.north && cell == other.cell &&
         columns == other.columns && rows == other.rows;
}

const RasterBand& Raster::band(const std::string& name) const {
  std::string names;
  for (const RasterBand& band : bands) {
    if (band.name == name) return band;
    names += (names.empty() ? "" : ", ") + band.name;
  }
  throw UsageError("band " + name + ": the raster has " + (names.empty() ? "none" : names));
}

RasterBand& Raster::addBand(const std::string& name) {
  bands.push_back({name, std::vector<float>(grid.cells(), RasterBand::kNoValue)});
  return bands.back();
}

}  // namespace pcl_als
