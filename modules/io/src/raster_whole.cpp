// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/raster_io.h>

namespace fs = std::filesystem;

namespace pcl_als {
namespace {

// Rows of tiles, so that each tile is compressed once, in pieces of bounded memory.
constexpr int kRows = 512;

template <typename Each>
void forWindows(const RasterGrid& grid, Each each) {
  for (int row = 0; row < grid.rows; row += kRows)
    each(RasterWindow{0, row, grid.columns, std::min(kRows, grid.rows - row)});
}

void checkCells(std::size_t values, const RasterGrid& grid, const std::string& what) {
  if (values != grid.cells())
    throw UsageError(what + ": has " + std::to_string(values) + " values for " +
                     std::to_string(grid.cells()) + " cells");
}

}  // namespace

void writeRaster(const fs::path& path, const Raster& raster, const RasterOptions& options) {
  RasterLayout layout;
  layout.grid = raster.grid;
  for (const RasterBand& band : raster.bands) {
    checkCells(band.values.size(), raster.grid, "band " + band.name);
    layout.bands.push_back(band.name);
  }
  RasterWriter writer(path, layout, options);
  for (std::size_t i = 0; i < raster.bands.size(); ++i)
    forWindows(raster.grid, [&](const RasterWindow& window) {
      writer.write(i, window, &raster.bands[i].values[raster.grid.index(0, window.row)]);
    });
  writer.commit();
}

Raster readRaster(const fs::path& path) {
  RasterReader reader(path);
  Raster raster;
  raster.grid = reader.layout().grid;
  for (std::size_t i = 0; i < reader.layout().bands.size(); ++i) {
    RasterBand& band = raster.addBand(reader.layout().bands[i]);
    reader.read(i, {0, 0, raster.grid.columns, raster.grid.rows}, band.values.data());
  }
  return raster;
}

void writeClassRaster(const fs::path& path, const ClassRaster& raster,
                      const RasterOptions& options) {
  checkCells(raster.values.size(), raster.grid, "a map of classes");
  RasterLayout layout;
  layout.grid = raster.grid;
  layout.type = RasterLayout::Type::byte;
  layout.bands = {"class"};
  layout.legend = raster.legend;
  RasterWriter writer(path, layout, options);
  forWindows(raster.grid, [&](const RasterWindow& window) {
    writer.write(0, window, &raster.values[raster.grid.index(0, window.row)]);
  });
  writer.commit();
}

ClassRaster readClassRaster(const fs::path& path) {
  RasterReader reader(path);
  ClassRaster raster;
  raster.grid = reader.layout().grid;
  raster.legend = reader.layout().legend;
  raster.values.resize(raster.grid.cells());
  reader.read(0, {0, 0, raster.grid.columns, raster.grid.rows}, raster.values.data());
  return raster;
}

}  // namespace pcl_als
