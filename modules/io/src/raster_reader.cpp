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
#include <pcl_als/io/raster_io.h>

#include "gdal_handle.h"
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

}  // namespace

struct RasterReader::State {
  explicit State(fs::path p) : path(std::move(p)), file(path) {}
  ~State() {
    const GdalReports reports(path);
    dataset.reset();
  }

  fs::path path;
  InputFile file;  ///< open beside GDAL, to notice when the file is changed
  RasterLayout layout;
  detail::Dataset dataset;
  std::vector<float> no_data;  ///< of each band; NaN: none
};

RasterReader::RasterReader(const fs::path& path) : state_(std::make_unique<State>(path)) {
  const GdalReports reports(path);
  const char* const drivers[] = {"GTiff", nullptr};
  detail::gdalDriver("GTiff");
  state_->dataset.reset(GDALOpenEx(path.string().c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                                   drivers, nullptr, nullptr));
  reports.check(state_->dataset != nullptr, "is no GeoTIFF that can be read");
  state_->layout = detail::layoutOf(state_->dataset.get(), reports);
  checkSize(state_->dataset.get(), path);
  for (std::size_t i = 0; i < state_->layout.bands.size(); ++i) {
    int has = 0;
    const double value = GDALGetRasterNoDataValue(
        GDALGetRasterBand(state_->dataset.get(), static_cast<int>(i) + 1), &has);
    state_->no_data.push_back(has != 0 ? static_cast<float>(value) : std::nanf(""));
  }
}

RasterReader::~RasterReader() = default;

const RasterLayout& RasterReader::layout() const {
  return state_->layout;
}

namespace {

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

}  // namespace

PointFileInfo RasterReader::info() const {
  const RasterGrid& grid = state_->layout.grid;
  const CrsDescription crs = describeCrs(grid.crs);
  PointFileInfo info;
  info.path = state_->path;
  info.point_count = grid.cells();
  info.minimum.head<2>() << grid.west, grid.north - grid.rows * grid.cell;
  info.maximum.head<2>() << grid.west + grid.columns * grid.cell, grid.north;
  info.version = state_->file.version();
  info.crs = grid.crs;
  info.crs_kind = crs.kind;
  info.units = unitsOfCrs(grid.crs);
  info.units.vertical = crs.vertical.value_or(LengthUnit());
  info.format = "GeoTIFF";
  const char* unit = GDALGetRasterUnitType(GDALGetRasterBand(state_->dataset.get(), 1));
  if (unit != nullptr && *unit != '\0') {
    info.units.vertical = unitSpelled(unit, state_->path);
    info.units.vertical_source = "the band";
  }
  return info;
}

int RasterReader::overviews() const {
  return GDALGetOverviewCount(GDALGetRasterBand(state_->dataset.get(), 1));
}

void RasterReader::read(std::size_t band, const RasterWindow& window, float* values) {
  detail::checkWindow(state_->layout, band, window);
  const GdalReports reports(state_->path);
  const GDALRasterBandH handle =
      GDALGetRasterBand(state_->dataset.get(), static_cast<int>(band) + 1);
  const CPLErr outcome =
      GDALRasterIO(handle, GF_Read, window.column, window.row, window.columns, window.rows, values,
                   window.columns, window.rows, GDT_Float32, 0, 0);
  reports.check(outcome == CE_None, "cannot be read");
  state_->file.requireUnchanged();
  const float no_data = state_->no_data[band];
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

void RasterReader::read(std::size_t band, const RasterWindow& window, std::uint8_t* values) {
  readReduced(band, window, window.columns, window.rows, values);
}

void RasterReader::readReduced(std::size_t band, const RasterWindow& window, int columns, int rows,
                               std::uint8_t* values) {
  detail::checkWindow(state_->layout, band, window);
  const GdalReports reports(state_->path);
  const GDALRasterBandH handle =
      GDALGetRasterBand(state_->dataset.get(), static_cast<int>(band) + 1);
  reports.check(GDALGetRasterDataType(handle) == GDT_Byte, "its cells are no bytes");
  GDALRasterIOExtraArg how;
  INIT_RASTERIO_EXTRA_ARG(how);
  how.eResampleAlg = GRIORA_Mode;
  const CPLErr outcome = GDALRasterIOEx(handle, GF_Read, window.column, window.row, window.columns,
                                        window.rows, values, columns, rows, GDT_Byte, 0, 0, &how);
  reports.check(outcome == CE_None, "cannot be read");
  state_->file.requireUnchanged();
}

}  // namespace pcl_als
