// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/io/raster_io.h>

namespace pcl_als::detail {

/// A raster that is being written, as RasterWriter, by some library.
class WrittenRaster {
 public:
  virtual ~WrittenRaster() = default;
  virtual const RasterLayout& layout() const = 0;
  virtual void write(std::size_t band, const RasterWindow& window, const float* values) = 0;
  virtual void write(std::size_t band, const RasterWindow& window, const std::uint8_t* values) = 0;
  virtual void commit() = 0;
};

/// A raster that is read, as RasterReader, by some library.
class OpenedRaster {
 public:
  virtual ~OpenedRaster() = default;
  virtual const RasterLayout& layout() const = 0;
  virtual PointFileInfo info() const = 0;
  virtual int overviews() const = 0;
  virtual void read(std::size_t band, const RasterWindow& window, float* values) = 0;
  virtual void readReduced(std::size_t band, const RasterWindow& window, int columns, int rows,
                           std::uint8_t* values) = 0;
};

/// GDAL's; of builds with it only.
std::unique_ptr<WrittenRaster> createWithGdal(const std::filesystem::path& path,
                                              RasterLayout layout, RasterOptions options);
std::unique_ptr<OpenedRaster> openWithGdal(const std::filesystem::path& path);

}  // namespace pcl_als::detail
