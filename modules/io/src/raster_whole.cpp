// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/memory.h>
#include <pcl_als/io/raster_io.h>

#include "raster_format.h"

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

/// Memory for \a bytes in all is there to be had, as far as one can know.
void checkMemory(const fs::path& path, double bytes) {
  const double present = physicalMemory();
  if (present > 0.0 && bytes > present)
    throw InputError(
        path.string() + ": as a whole needs " + std::to_string(std::llround(bytes / 1e9)) +
        " GB of memory, this machine has " + std::to_string(std::llround(present / 1e9)));
}

void checkCells(std::size_t values, const RasterGrid& grid, const std::string& what) {
  if (values != grid.cells())
    throw UsageError(what + ": has " + std::to_string(values) + " values for " +
                     std::to_string(grid.cells()) + " cells");
}

}  // namespace

#ifdef PCL_ALS_HAVE_GDAL
RasterWriter::RasterWriter(const fs::path& path, RasterLayout layout, RasterOptions options)
    : file_(detail::createWithGdal(path, std::move(layout), std::move(options))) {}
RasterReader::RasterReader(const fs::path& path) : file_(detail::openWithGdal(path)) {}
#else
constexpr const char* kNoGdal =
    ": rasters need GDAL; build with -DPCL_ALS_WITH_GDAL=ON and libgdal-dev";
RasterWriter::RasterWriter(const fs::path& path, RasterLayout, RasterOptions) {
  throw InputError(path.string() + kNoGdal);
}
RasterReader::RasterReader(const fs::path& path) {
  throw InputError(path.string() + kNoGdal);
}
#endif

RasterWriter::~RasterWriter() = default;
const RasterLayout& RasterWriter::layout() const {
  return file_->layout();
}
void RasterWriter::write(std::size_t band, const RasterWindow& window, const float* values) {
  file_->write(band, window, values);
}
void RasterWriter::write(std::size_t band, const RasterWindow& window, const std::uint8_t* values) {
  file_->write(band, window, values);
}
void RasterWriter::commit() {
  file_->commit();
}

RasterReader::~RasterReader() = default;
const RasterLayout& RasterReader::layout() const {
  return file_->layout();
}
PointFileInfo RasterReader::info() const {
  return file_->info();
}
int RasterReader::overviews() const {
  return file_->overviews();
}
void RasterReader::read(std::size_t band, const RasterWindow& window, float* values) {
  file_->read(band, window, values);
}
void RasterReader::read(std::size_t band, const RasterWindow& window, std::uint8_t* values) {
  file_->readReduced(band, window, window.columns, window.rows, values);
}
void RasterReader::readReduced(std::size_t band, const RasterWindow& window, int columns, int rows,
                               std::uint8_t* values) {
  file_->readReduced(band, window, columns, rows, values);
}

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
  checkMemory(path, double(sizeof(float)) * static_cast<double>(raster.grid.cells()) *
                        static_cast<double>(reader.layout().bands.size()));
  for (std::size_t i = 0; i < reader.layout().bands.size(); ++i) {
    RasterBand& band = raster.addBand(reader.layout().bands[i]);
    reader.read(i, {0, 0, raster.grid.columns, raster.grid.rows}, band.values.data());
  }
  return raster;
}

void writeCodeRaster(const fs::path& path, const CodeRaster& raster, const RasterOptions& options) {
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

CodeRaster readCodeRaster(const fs::path& path, int largest_side) {
  RasterReader reader(path);
  CodeRaster raster;
  raster.grid = reader.layout().grid;
  raster.legend = reader.layout().legend;
  RasterGrid& grid = raster.grid;
  const int side = std::max(grid.columns, grid.rows);
  const int factor = largest_side > 0 ? (side - 1) / largest_side + 1 : 1;
  RasterWindow window{0, 0, grid.columns, grid.rows};
  if (factor > 1) {
    grid.columns = std::max(1, grid.columns / factor);
    grid.rows = std::max(1, grid.rows / factor);
    grid.cell *= factor;
    window.columns = std::min(window.columns, grid.columns * factor);
    window.rows = std::min(window.rows, grid.rows * factor);
  }
  checkMemory(path, static_cast<double>(grid.cells()));
  raster.values.resize(grid.cells());
  reader.readReduced(0, window, grid.columns, grid.rows, raster.values.data());
  return raster;
}

}  // namespace pcl_als
