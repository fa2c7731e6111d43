// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <filesystem>

#include <pcl_als/io/class_io.h>
#include <pcl_als/io/raster_io.h>
#include <pcl_als/processing/class_model_file.h>
#include <pcl_als/report/accuracy_report.h>

#include "fuzz_seeds.h"
#include "fuzz_targets.h"

namespace pcl_als::fuzz {
namespace {

void assess(const ConfusionMatrix& matrix) {
  if (matrix.total() == 0) return;
  AccuracyReport report{matrix, assessAccuracy(matrix), {}, {}, {}, {}, {}, {}};
  report.other = report.result;
  report.comparison = compareAccuracy(matrix, matrix);
  accuracyText(report);
}

void readMatrix(const std::filesystem::path& path) {
  if (holdsCheckedSites(path)) return;
  assess(matrixOf(readCountTable(path)));
}

void readChecked(const std::filesystem::path& path) {
  const std::vector<CheckedSite> sites = readCheckedSites(path);
  const CountedSites counted = countSites(sites, {});
  assess(countPoints(counted.classes, counted.points));
  assessSites(counted);
  matchSites(path.string(), sites, sites);
}

void useModel(const std::filesystem::path& path) {
  const GaussianModel model = readClassModel(path);
  const MaximumLikelihood classifier(model, 0.01);
  std::vector<double> values(model.bands.size(), 1.5);
  classifier.classify(values.data());
}

void readGeoTiff(const std::filesystem::path& path) {
  RasterReader reader(path);
  const RasterGrid& grid = reader.layout().grid;
  const RasterWindow corner{grid.columns - std::min(grid.columns, 70),
                            grid.rows - std::min(grid.rows, 70), std::min(grid.columns, 70),
                            std::min(grid.rows, 70)};
  std::vector<float> values(corner.cells());
  for (std::size_t band = 0; band < std::min<std::size_t>(reader.layout().bands.size(), 4); ++band)
    reader.read(band, corner, values.data());
  if (grid.cells() <= 1U << 20U) readRaster(path);
  if (reader.layout().type == RasterLayout::Type::byte) readCodeRaster(path, 300);
}

bool geojson(const std::uint8_t* data, std::size_t size) {
  return readAs(".geojson", data, size, [](const auto& path) { readClassSites(path); });
}
bool sites(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, [](const auto& path) { readClassSites(path); });
}
bool countTable(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, readMatrix);
}
bool checkedSites(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, readChecked);
}
bool classModel(const std::uint8_t* data, std::size_t size) {
  return readAs(".json", data, size, useModel);
}
#ifdef PCL_ALS_HAVE_GDAL
bool geoTiff(const std::uint8_t* data, std::size_t size) {
  return readAs(".tif", data, size, readGeoTiff);
}
#endif

}  // namespace

const std::vector<Target>& landCoverTargets() {
  static const std::vector<Target> all = {
      {"geojson", geojson, geoJsonSeeds},
      {"class_sites", sites, classSiteSeeds},
      {"confusion_matrix", countTable, countTableSeeds},
      {"checked_sites", checkedSites, checkedSiteSeeds},
      {"class_model", classModel, classModelSeeds},
#ifdef PCL_ALS_HAVE_GDAL
      {"geotiff", geoTiff, geoTiffSeeds},
#endif
  };
  return all;
}

}  // namespace pcl_als::fuzz
