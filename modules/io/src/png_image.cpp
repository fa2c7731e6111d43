// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/raster_io.h>

#include "gdal_handle.h"

namespace fs = std::filesystem;

namespace pcl_als {

using detail::Dataset;
using detail::GdalReports;

void writePngImage(const fs::path& path, const PngImage& image) {
  const auto pixels = static_cast<std::size_t>(image.width) * image.height;
  if (image.width <= 0 || image.height <= 0 || (image.channels != 3 && image.channels != 4) ||
      image.pixels.size() != pixels * image.channels)
    throw UsageError("an image whose pixels do not fit its size and channels");
  AtomicFile file(path);
  {
    const GdalReports reports(path, {file.temporaryPath()});
    const Dataset memory(GDALCreate(detail::gdalDriver("MEM"), "", image.width, image.height,
                                    image.channels, GDT_Byte, nullptr));
    reports.check(memory != nullptr, "cannot be written");
    const CPLErr filled = GDALDatasetRasterIO(
        memory.get(), GF_Write, 0, 0, image.width, image.height,
        const_cast<std::uint8_t*>(image.pixels.data()), image.width, image.height, GDT_Byte,
        image.channels, nullptr, image.channels, image.width * image.channels, 1);
    reports.check(filled == CE_None, "cannot be written");
    Dataset copy(GDALCreateCopy(detail::gdalDriver("PNG"), file.temporaryPath().string().c_str(),
                                memory.get(), 0, nullptr, nullptr, nullptr));
    reports.check(copy != nullptr, "cannot be written");
    copy.reset();
    reports.check(true, "cannot be written");
  }
  file.commit();
}

PngImage readPngImage(const fs::path& path) {
  const GdalReports reports(path);
  const char* const drivers[] = {"PNG", nullptr};
  detail::gdalDriver("PNG");
  const Dataset dataset(GDALOpenEx(path.string().c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                                   drivers, nullptr, nullptr));
  reports.check(dataset != nullptr, "is no PNG that can be read");
  PngImage image;
  image.width = GDALGetRasterXSize(dataset.get());
  image.height = GDALGetRasterYSize(dataset.get());
  image.channels = GDALGetRasterCount(dataset.get());
  reports.check(image.channels == 3 || image.channels == 4, "is no PNG of RGB or RGBA pixels");
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height * image.channels);
  const CPLErr outcome =
      GDALDatasetRasterIO(dataset.get(), GF_Read, 0, 0, image.width, image.height,
                          image.pixels.data(), image.width, image.height, GDT_Byte, image.channels,
                          nullptr, image.channels, image.width * image.channels, 1);
  reports.check(outcome == CE_None, "cannot be read");
  return image;
}

}  // namespace pcl_als
