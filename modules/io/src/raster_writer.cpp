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
#include <pcl_als/io/raster_io.h>

#include "gdal_handle.h"
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

}  // namespace

struct RasterWriter::State {
  State(const fs::path& target, RasterLayout what, RasterOptions how)
      : path(target), layout(std::move(what)), options(std::move(how)), final_file(target) {}

  ~State() {
    const GdalReports dropped = reports();  // what closing reports is of no interest
    dataset.reset();
  }

  /// Messages name the file that the user named, not those that GDAL works on.
  GdalReports reports() const {
    std::vector<fs::path> temporaries{final_file.temporaryPath()};
    if (draft) temporaries.push_back(draft->temporaryPath());
    return GdalReports(options.named.empty() ? path : options.named, temporaries);
  }
  bool bytes() const { return layout.type == RasterLayout::Type::byte; }
  void create();
  void buildOverviews(const GdalReports& reports);
  void copyCloudOptimised(const GdalReports& reports);
  void close(const GdalReports& reports) {
    dataset.reset();
    reports.check(true, "cannot be written");
  }

  fs::path path;
  RasterLayout layout;
  RasterOptions options;
  AtomicFile final_file;
  std::optional<AtomicFile> draft;  ///< where the final file is a rearranged copy
  Dataset dataset;
};

void RasterWriter::State::create() {
  if (options.cloud_optimised && detail::gdalDriver("COG") != nullptr) draft.emplace(path);
  const GdalReports reports = this->reports();
  CreationOptions creation;
  creation.add("TILED=YES");
  creation.add("BLOCKXSIZE=" + std::to_string(kTile));
  creation.add("BLOCKYSIZE=" + std::to_string(kTile));
  if (layout.bands.size() > 1) creation.add("INTERLEAVE=BAND");
  // The draft is deleted soon: compressing it costs more than writing it.
  if (draft || !options.compress) {
    creation.add("BIGTIFF=IF_SAFER");
  } else {
    addCompression(creation, bytes(), false, options.threads);
  }
  const std::string name = (draft ? *draft : final_file).temporaryPath().string();
  dataset.reset(GDALCreate(detail::gdalDriver("GTiff"), name.c_str(), layout.grid.columns,
                           layout.grid.rows, static_cast<int>(layout.bands.size()),
                           bytes() ? GDT_Byte : GDT_Float32, creation.get()));
  reports.check(dataset != nullptr, "cannot be created");
  detail::describeDataset(dataset.get(), layout, reports);
}

void RasterWriter::State::buildOverviews(const GdalReports& reports) {
  std::vector<int> levels;
  int side = std::max(layout.grid.columns, layout.grid.rows);
  for (int factor = 2; side > kSmallestOverview; factor *= 2, side = (side + 1) / 2)
    levels.push_back(factor);
  if (levels.empty()) return;
  const CPLErr outcome = GDALBuildOverviews(dataset.get(), bytes() ? "MODE" : "AVERAGE",
                                            static_cast<int>(levels.size()), levels.data(), 0,
                                            nullptr, nullptr, nullptr);
  reports.check(outcome == CE_None, "cannot be written");
}

void RasterWriter::State::copyCloudOptimised(const GdalReports& reports) {
  CreationOptions creation;
  addCompression(creation, bytes(), true, options.threads);
  creation.add("BLOCKSIZE=" + std::to_string(kTile));
  creation.add(options.overviews ? "OVERVIEWS=AUTO" : "OVERVIEWS=NONE");
  // AUTO takes the overviews there are; small rasters, which have none, need none.
  creation.add(bytes() ? "OVERVIEW_RESAMPLING=MODE" : "OVERVIEW_RESAMPLING=AVERAGE");
  const std::string name = final_file.temporaryPath().string();
  const Dataset copy(GDALCreateCopy(detail::gdalDriver("COG"), name.c_str(), dataset.get(), 1,
                                    creation.get(), nullptr, nullptr));
  reports.check(copy != nullptr, "cannot be written");
}

RasterWriter::RasterWriter(const fs::path& path, RasterLayout layout, RasterOptions options) {
  checkLayout(layout);
  state_ = std::make_unique<State>(path, std::move(layout), std::move(options));
  state_->create();
}

RasterWriter::~RasterWriter() = default;

const RasterLayout& RasterWriter::layout() const {
  return state_->layout;
}

void RasterWriter::write(std::size_t band, const RasterWindow& window, const float* values) {
  detail::checkWindow(state_->layout, band, window);
  if (state_->bytes()) throw UsageError("floats for a raster of bytes");
  std::vector<float> filled(values, values + window.cells());
  const auto no_data = static_cast<float>(state_->layout.no_data);
  for (float& value : filled)
    if (std::isnan(value)) value = no_data;
  const GdalReports reports = state_->reports();
  const CPLErr outcome =
      GDALRasterIO(GDALGetRasterBand(state_->dataset.get(), static_cast<int>(band) + 1), GF_Write,
                   window.column, window.row, window.columns, window.rows, filled.data(),
                   window.columns, window.rows, GDT_Float32, 0, 0);
  reports.check(outcome == CE_None, "cannot be written");
}

void RasterWriter::write(std::size_t band, const RasterWindow& window, const std::uint8_t* values) {
  detail::checkWindow(state_->layout, band, window);
  if (!state_->bytes()) throw UsageError("bytes for a raster of floats");
  const GdalReports reports = state_->reports();
  const CPLErr outcome =
      GDALRasterIO(GDALGetRasterBand(state_->dataset.get(), static_cast<int>(band) + 1), GF_Write,
                   window.column, window.row, window.columns, window.rows,
                   const_cast<std::uint8_t*>(values), window.columns, window.rows, GDT_Byte, 0, 0);
  reports.check(outcome == CE_None, "cannot be written");
}

void RasterWriter::commit() {
  if (state_->dataset == nullptr)
    throw InputError(state_->path.string() + ": was already completed");
  {
    const GdalReports reports = state_->reports();
    GDALFlushCache(state_->dataset.get());
    reports.check(true, "cannot be written");
    if (state_->options.overviews) state_->buildOverviews(reports);
    if (state_->draft) state_->copyCloudOptimised(reports);
    state_->close(reports);
  }
  state_->draft.reset();
  state_->final_file.commit();
}

}  // namespace pcl_als
