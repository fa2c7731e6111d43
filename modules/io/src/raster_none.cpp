// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Takes the place of GDAL's part in a build without it.
#include <pcl_als/common/errors.h>
#include <pcl_als/io/raster_io.h>

namespace fs = std::filesystem;

namespace pcl_als {
namespace {

[[noreturn]] void refuse(const fs::path& path) {
  throw InputError(
      path.string() +
      ": rasters and PNG need GDAL; build with -DPCL_ALS_WITH_GDAL=ON and libgdal-dev");
}

}  // namespace

struct RasterWriter::State {
  RasterLayout layout;
};
RasterWriter::RasterWriter(const fs::path& path, RasterLayout, RasterOptions) {
  refuse(path);
}
RasterWriter::~RasterWriter() = default;
const RasterLayout& RasterWriter::layout() const {
  return state_->layout;
}
void RasterWriter::write(std::size_t, const RasterWindow&, const float*) {}
void RasterWriter::write(std::size_t, const RasterWindow&, const std::uint8_t*) {}
void RasterWriter::commit() {}

struct RasterReader::State {
  RasterLayout layout;
};
RasterReader::RasterReader(const fs::path& path) {
  refuse(path);
}
RasterReader::~RasterReader() = default;
const RasterLayout& RasterReader::layout() const {
  return state_->layout;
}
PointFileInfo RasterReader::info() const {
  return {};
}
int RasterReader::overviews() const {
  return 0;
}
void RasterReader::read(std::size_t, const RasterWindow&, float*) {}
void RasterReader::read(std::size_t, const RasterWindow&, std::uint8_t*) {}
void RasterReader::readReduced(std::size_t, const RasterWindow&, int, int, std::uint8_t*) {}

void writePngImage(const fs::path& path, const PngImage&) {
  refuse(path);
}
PngImage readPngImage(const fs::path& path) {
  refuse(path);
}

}  // namespace pcl_als
