// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/raster_io.h>

#include "gdal_handle.h"
#include "raster_georeference.h"

namespace fs = std::filesystem;

namespace pcl_als {

using detail::GdalReports;

struct RasterReader::State {
  ~State() {
    const GdalReports reports(path);
    dataset.reset();
  }

  fs::path path;
  RasterLayout layout;
  detail::Dataset dataset;
  std::vector<float> no_data;  ///< of each band; NaN: none
};

RasterReader::RasterReader(const fs::path& path) : state_(std::make_unique<State>()) {
  std::error_code error;
  if (!fs::is_regular_file(path, error))
    throw InputError(path.string() + ": does not exist or is no file");
  state_->path = path;
  const GdalReports reports(path);
  const char* const drivers[] = {"GTiff", nullptr};
  detail::gdalDriver("GTiff");
  state_->dataset.reset(GDALOpenEx(path.string().c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                                   drivers, nullptr, nullptr));
  reports.check(state_->dataset != nullptr, "is no GeoTIFF that can be read");
  state_->layout = detail::layoutOf(state_->dataset.get(), reports);
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

int RasterReader::overviews() const {
  return GDALGetOverviewCount(GDALGetRasterBand(state_->dataset.get(), 1));
}

void RasterReader::read(std::size_t band, const RasterWindow& window, float* values) {
  detail::checkWindow(state_->layout, band, window);
  const GdalReports reports(state_->path);
  const CPLErr outcome =
      GDALRasterIO(GDALGetRasterBand(state_->dataset.get(), static_cast<int>(band) + 1), GF_Read,
                   window.column, window.row, window.columns, window.rows, values, window.columns,
                   window.rows, GDT_Float32, 0, 0);
  reports.check(outcome == CE_None, "cannot be read");
  const float no_data = state_->no_data[band];
  if (std::isnan(no_data)) return;
  for (std::size_t i = 0; i < window.cells(); ++i)
    if (values[i] == no_data) values[i] = RasterBand::kNoValue;
}

void RasterReader::read(std::size_t band, const RasterWindow& window, std::uint8_t* values) {
  detail::checkWindow(state_->layout, band, window);
  const GdalReports reports(state_->path);
  const GDALRasterBandH handle =
      GDALGetRasterBand(state_->dataset.get(), static_cast<int>(band) + 1);
  reports.check(GDALGetRasterDataType(handle) == GDT_Byte, "its cells are no bytes");
  const CPLErr outcome =
      GDALRasterIO(handle, GF_Read, window.column, window.row, window.columns, window.rows, values,
                   window.columns, window.rows, GDT_Byte, 0, 0);
  reports.check(outcome == CE_None, "cannot be read");
}

}  // namespace pcl_als
