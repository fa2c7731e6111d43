// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>

#include "gdal_handle.h"
#include "raster_format.h"
#include "raster_georeference.h"

namespace fs = std::filesystem;

namespace pcl_als {

using detail::Dataset;
using detail::GdalReports;

namespace {

constexpr int kTile = 512;
constexpr int kSmallestOverview = 256;

/// Options of a driver as GDAL wants them: a list of C strings that ends with null.
class CreationOptions {
 public:
  void add(std::string option) { options_.push_back(std::move(option)); }
  char** get() {
    pointers_.clear();
    for (std::string& option : options_) pointers_.push_back(option.data());
    pointers_.push_back(nullptr);
    return pointers_.data();
  }

 private:
  std::vector<std::string> options_;
  std::vector<char*> pointers_;
};

void addCompression(CreationOptions& options, bool bytes, bool cog, int threads) {
  options.add("COMPRESS=DEFLATE");
  options.add("BIGTIFF=IF_SAFER");
  options.add("NUM_THREADS=" + std::to_string(threadCount(threads)));
  if (!bytes) options.add(cog ? "PREDICTOR=FLOATING_POINT" : "PREDICTOR=3");
}

void checkLayout(const RasterLayout& layout) {
  const RasterGrid& grid = layout.grid;
  if (grid.columns <= 0 || grid.rows <= 0 || !(grid.cell > 0.0))
    throw UsageError("a raster without cells cannot be written");
  if (layout.bands.empty()) throw UsageError("a raster without bands cannot be written");
}

class GdalOutput : public detail::WrittenRaster {
 public:
  GdalOutput(const fs::path& target, RasterLayout what, RasterOptions how)
      : path_(target), layout_(std::move(what)), options_(std::move(how)), final_file_(target) {}
  ~GdalOutput() override {
    const GdalReports dropped = reports();  // what closing reports is of no interest
    dataset_.reset();
  }
  void create();
  const RasterLayout& layout() const override { return layout_; }
  void write(std::size_t band, const RasterWindow& window, const float* values) override;
  void write(std::size_t band, const RasterWindow& window, const std::uint8_t* values) override;
  void commit() override;

 private:
  /// Messages name the file that the user named, not those that GDAL works on.
  GdalReports reports() const {
    std::vector<fs::path> temporaries{final_file_.temporaryPath()};
    if (draft_) temporaries.push_back(draft_->temporaryPath());
    return GdalReports(options_.named.empty() ? path_ : options_.named, temporaries);
  }
  bool bytes() const { return layout_.type == RasterLayout::Type::byte; }
  void buildOverviews(const GdalReports& reports);
  void copyCloudOptimised(const GdalReports& reports);
  void close(const GdalReports& reports) {
    dataset_.reset();
    reports.check(true, "cannot be written");
  }

  fs::path path_;
  RasterLayout layout_;
  RasterOptions options_;
  AtomicFile final_file_;
  std::optional<AtomicFile> draft_;  ///< where the final file is a rearranged copy
  detail::Dataset dataset_;
};

void GdalOutput::create() {
  if (options_.cloud_optimised && detail::gdalDriver("COG") != nullptr) draft_.emplace(path_);
  const GdalReports reports = this->reports();
  CreationOptions creation;
  creation.add("TILED=YES");
  creation.add("BLOCKXSIZE=" + std::to_string(kTile));
  creation.add("BLOCKYSIZE=" + std::to_string(kTile));
  if (layout_.bands.size() > 1) creation.add("INTERLEAVE=BAND");
  // The draft_ is deleted soon: compressing it costs more than writing it.
  if (draft_ || !options_.compress) {
    creation.add("BIGTIFF=IF_SAFER");
  } else {
    addCompression(creation, bytes(), false, options_.threads);
  }
  const std::string name = (draft_ ? *draft_ : final_file_).temporaryPath().string();
  dataset_.reset(GDALCreate(detail::gdalDriver("GTiff"), name.c_str(), layout_.grid.columns,
                            layout_.grid.rows, static_cast<int>(layout_.bands.size()),
                            bytes() ? GDT_Byte : GDT_Float32, creation.get()));
  reports.check(dataset_ != nullptr, "cannot be created");
  detail::describeDataset(dataset_.get(), layout_, reports);
}

void GdalOutput::buildOverviews(const GdalReports& reports) {
  std::vector<int> levels;
  int side = std::max(layout_.grid.columns, layout_.grid.rows);
  for (int factor = 2; side > kSmallestOverview; factor *= 2, side = (side + 1) / 2)
    levels.push_back(factor);
  if (levels.empty()) return;
  const CPLErr outcome = GDALBuildOverviews(dataset_.get(), bytes() ? "MODE" : "AVERAGE",
                                            static_cast<int>(levels.size()), levels.data(), 0,
                                            nullptr, nullptr, nullptr);
  reports.check(outcome == CE_None, "cannot be written");
}

void GdalOutput::copyCloudOptimised(const GdalReports& reports) {
  CreationOptions creation;
  addCompression(creation, bytes(), true, options_.threads);
  creation.add("BLOCKSIZE=" + std::to_string(kTile));
  creation.add(options_.overviews ? "OVERVIEWS=AUTO" : "OVERVIEWS=NONE");
  // AUTO takes the overviews there are; small rasters, which have none, need none.
  creation.add(bytes() ? "OVERVIEW_RESAMPLING=MODE" : "OVERVIEW_RESAMPLING=AVERAGE");
  const std::string name = final_file_.temporaryPath().string();
  const Dataset copy(GDALCreateCopy(detail::gdalDriver("COG"), name.c_str(), dataset_.get(), 1,
                                    creation.get(), nullptr, nullptr));
  reports.check(copy != nullptr, "cannot be written");
}

void GdalOutput::write(std::size_t band, const RasterWindow& window, const float* values) {
  detail::checkWindow(layout_, band, window);
  if (bytes()) throw UsageError("floats for a raster of bytes");
  std::vector<float> filled(values, values + window.cells());
  const auto no_data = static_cast<float>(layout_.no_data);
  for (float& value : filled)
    if (std::isnan(value)) value = no_data;
  const GdalReports reports = this->reports();
  const CPLErr outcome =
      GDALRasterIO(GDALGetRasterBand(dataset_.get(), static_cast<int>(band) + 1), GF_Write,
                   window.column, window.row, window.columns, window.rows, filled.data(),
                   window.columns, window.rows, GDT_Float32, 0, 0);
  reports.check(outcome == CE_None, "cannot be written");
}

void GdalOutput::write(std::size_t band, const RasterWindow& window, const std::uint8_t* values) {
  detail::checkWindow(layout_, band, window);
  if (!bytes()) throw UsageError("bytes for a raster of floats");
  const GdalReports reports = this->reports();
  const CPLErr outcome =
      GDALRasterIO(GDALGetRasterBand(dataset_.get(), static_cast<int>(band) + 1), GF_Write,
                   window.column, window.row, window.columns, window.rows,
                   const_cast<std::uint8_t*>(values), window.columns, window.rows, GDT_Byte, 0, 0);
  reports.check(outcome == CE_None, "cannot be written");
}

void GdalOutput::commit() {
  if (dataset_ == nullptr) throw InputError(path_.string() + ": was already completed");
  {
    const GdalReports reports = this->reports();
    GDALFlushCache(dataset_.get());
    reports.check(true, "cannot be written");
    if (options_.overviews) buildOverviews(reports);
    if (draft_) copyCloudOptimised(reports);
    close(reports);
  }
  draft_.reset();
  final_file_.commit();
}

}  // namespace

std::unique_ptr<detail::WrittenRaster> detail::createWithGdal(const fs::path& path,
                                                              RasterLayout layout,
                                                              RasterOptions options) {
  checkLayout(layout);
  auto file = std::make_unique<GdalOutput>(path, std::move(layout), std::move(options));
  file->create();
  return file;
}

}  // namespace pcl_als
