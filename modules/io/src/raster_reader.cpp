// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/crs/crs.h>

#include "gdal_handle.h"
#include "raster_format.h"
#include "raster_georeference.h"

namespace fs = std::filesystem;

namespace pcl_als {

using detail::GdalReports;

namespace {

// The emptiest block of 512 x 512 cells is some 64 bytes of file with its place in the index.
constexpr double kMostCellsPerByte = 65536.0;
constexpr double kLargestBlock = 512.0 * 1024.0 * 1024.0;

/// A header of a few bytes may declare any number of cells; reading them must not take the machine.
void checkSize(GDALDatasetH dataset, const fs::path& path) {
  const double columns = GDALGetRasterXSize(dataset), rows = GDALGetRasterYSize(dataset);
  std::error_code error;
  const auto bytes = static_cast<double>(fs::file_size(path, error));
  if (!error && columns * rows * GDALGetRasterCount(dataset) > kMostCellsPerByte * bytes)
    throw InputError(path.string() + ": its header declares " + std::to_string(int(columns)) +
                     " x " + std::to_string(int(rows)) +
                     " cells, more than a file of its size can hold");
  const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
  int width = 0, height = 0;
  GDALGetBlockSize(band, &width, &height);
  // Where the bands lie cell by cell, GDAL unpacks a block of all of them.
  const char* order = GDALGetMetadataItem(dataset, "INTERLEAVE", "IMAGE_STRUCTURE");
  const bool together = order != nullptr && std::strcmp(order, "PIXEL") == 0;
  const double bytes_of_cell = double(GDALGetDataTypeSizeBytes(GDALGetRasterDataType(band))) *
                               (together ? GDALGetRasterCount(dataset) : 1);
  if (double(width) * height * bytes_of_cell > kLargestBlock)
    throw InputError(path.string() + ": has blocks of " + std::to_string(width) + " x " +
                     std::to_string(height) + " cells, too large to read; rewrite it in tiles");
}

class GdalRaster : public detail::OpenedRaster {
 public:
  explicit GdalRaster(const fs::path& path) : path_(path), file_(path) {}
  ~GdalRaster() override {
    const GdalReports reports(path_);
    dataset_.reset();
  }
  void open();
  const RasterLayout& layout() const override { return layout_; }
  PointFileInfo info() const override;
  int overviews() const override {
    return GDALGetOverviewCount(GDALGetRasterBand(dataset_.get(), 1));
  }
  void read(std::size_t band, const RasterWindow& window, float* values) override;
  void readReduced(std::size_t band, const RasterWindow& window, int columns, int rows,
                   std::uint8_t* values) override;

 private:
  fs::path path_;
  InputFile file_;  ///< open beside GDAL, to notice when the file is changed
  RasterLayout layout_;
  detail::Dataset dataset_;
  std::vector<float> no_data_;  ///< of each band; NaN: none
};

void GdalRaster::open() {
  const GdalReports reports(path_);
  const char* const drivers[] = {"GTiff", nullptr};
  detail::gdalDriver("GTiff");
  dataset_.reset(GDALOpenEx(path_.string().c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers,
                            nullptr, nullptr));
  reports.check(dataset_ != nullptr, "is no GeoTIFF that can be read");
  layout_ = detail::layoutOf(dataset_.get(), reports);
  checkSize(dataset_.get(), path_);
  for (std::size_t i = 0; i < layout_.bands.size(); ++i) {
    int has = 0;
    const double value =
        GDALGetRasterNoDataValue(GDALGetRasterBand(dataset_.get(), static_cast<int>(i) + 1), &has);
    no_data_.push_back(has != 0 ? static_cast<float>(value) : std::nanf(""));
  }
}

/// A unit of length as GDAL, ESRI or PROJ spell it.
LengthUnit unitSpelled(std::string text, const fs::path& path) {
  const std::pair<const char*, std::vector<std::string>> units[] = {
      {"m", {"m", "metre", "meter", "metres", "meters"}},
      {"ft", {"ft", "foot", "feet", "international foot"}},
      {"us_ft", {"us_ft", "us-ft", "ftus", "us survey foot", "us_survey_foot", "foot_us"}}};
  const std::string given = text;
  for (char& letter : text)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const auto& [unit, names] : units) {
    if (std::find(names.begin(), names.end(), text) != names.end())
      return lengthUnitNamed(unit, path.string());
  }
  throw InputError(path.string() + ": its values are in '" + given +
                   "', which is no known unit of length");
}

PointFileInfo GdalRaster::info() const {
  const RasterGrid& grid = layout_.grid;
  const CrsDescription crs = describeCrs(grid.crs);
  PointFileInfo info;
  info.path = path_;
  info.point_count = grid.cells();
  info.minimum.head<2>() << grid.west, grid.north - grid.rows * grid.cell;
  info.maximum.head<2>() << grid.west + grid.columns * grid.cell, grid.north;
  info.version = file_.version();
  info.crs = grid.crs;
  info.crs_kind = crs.kind;
  info.units = unitsOfCrs(grid.crs);
  info.units.vertical = crs.vertical.value_or(LengthUnit());
  info.format = "GeoTIFF";
  const char* unit = GDALGetRasterUnitType(GDALGetRasterBand(dataset_.get(), 1));
  if (unit != nullptr && *unit != '\0') {
    info.units.vertical = unitSpelled(unit, path_);
    info.units.vertical_source = "the band";
  }
  return info;
}

void GdalRaster::read(std::size_t band, const RasterWindow& window, float* values) {
  detail::checkWindow(layout_, band, window);
  const GdalReports reports(path_);
  const GDALRasterBandH handle = GDALGetRasterBand(dataset_.get(), static_cast<int>(band) + 1);
  const CPLErr outcome =
      GDALRasterIO(handle, GF_Read, window.column, window.row, window.columns, window.rows, values,
                   window.columns, window.rows, GDT_Float32, 0, 0);
  reports.check(outcome == CE_None, "cannot be read");
  file_.requireUnchanged();
  const float no_data = no_data_[band];
  const double scale = GDALGetRasterScale(handle, nullptr);
  const double offset = GDALGetRasterOffset(handle, nullptr);
  const bool scaled = scale != 1.0 || offset != 0.0;
  for (std::size_t i = 0; i < window.cells(); ++i) {
    if (values[i] == no_data)
      values[i] = RasterBand::kNoValue;
    else if (scaled)
      values[i] = static_cast<float>(scale * static_cast<double>(values[i]) + offset);
  }
}

void GdalRaster::readReduced(std::size_t band, const RasterWindow& window, int columns, int rows,
                             std::uint8_t* values) {
  detail::checkWindow(layout_, band, window);
  const GdalReports reports(path_);
  const GDALRasterBandH handle = GDALGetRasterBand(dataset_.get(), static_cast<int>(band) + 1);
  reports.check(GDALGetRasterDataType(handle) == GDT_Byte, "its cells are no bytes");
  GDALRasterIOExtraArg how;
  INIT_RASTERIO_EXTRA_ARG(how);
  how.eResampleAlg = GRIORA_Mode;
  const CPLErr outcome = GDALRasterIOEx(handle, GF_Read, window.column, window.row, window.columns,
                                        window.rows, values, columns, rows, GDT_Byte, 0, 0, &how);
  reports.check(outcome == CE_None, "cannot be read");
  file_.requireUnchanged();
}

}  // namespace

std::unique_ptr<detail::OpenedRaster> detail::openWithGdal(const fs::path& path) {
  auto file = std::make_unique<GdalRaster>(path);
  file->open();
  return file;
}

}  // namespace pcl_als
