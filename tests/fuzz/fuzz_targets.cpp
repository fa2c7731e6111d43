// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "fuzz_targets.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include <unistd.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/class_io.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/raster_io.h>
#include <pcl_als/io/survey_census.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/class_model_file.h>
#include <pcl_als/report/accuracy_report.h>

#include "fuzz_seeds.h"

namespace pcl_als::fuzz {
namespace {

/// The bytes as a file that reader is called with; only the library's own errors are swallowed.
bool readAs(const char* extension, const std::uint8_t* data, std::size_t size,
            const std::function<void(const std::filesystem::path&)>& reader) {
  static const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const auto path = folder / ("pcl_als_fuzz." + std::to_string(getpid()) + extension);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  bool accepted = true;
  try {
    reader(path);
  } catch (const Error&) {
    accepted = false;
  }
  std::filesystem::remove(path);
  return accepted;
}

/// A small file may hold many equal points: some are enough.
void readLaz(const LasFile& file) {
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 22U;
  const LasHeader& header = file.header();
  const std::uint64_t count =
      std::min<std::uint64_t>(header.point_count, most_bytes / header.record_length);
  std::vector<std::byte> records(count * header.record_length);
  file.readRecords(count / 2, count - count / 2, records.data());
  for (std::uint64_t first = 0; first < count; first += 1000)
    file.readRecords(first, std::min<std::uint64_t>(1000, count - first), records.data());
}

/// What is intact of a damaged file; a small one may announce very many points.
void readIntact(const std::filesystem::path& path) {
  constexpr std::uint64_t most = std::uint64_t{1} << 20U;
  const LasFile file(path, kLazAllFields, LasDamage::keep_intact);
  if (file.header().point_count > most || file.header().record_length > 1000) return;
  std::vector<std::byte> records;
  for (const LasRecordRange& range : file.intact().records) {
    records.resize(range.count * file.header().record_length);
    file.readRanges({range}, records.data());
  }
}

void readLas(const std::filesystem::path& path) {
  const LasFile file(path);
  for (const LasVlrEntry& vlr : file.vlrs()) file.payload(vlr);
  file.info();
  const LasHeader& header = file.header();
  if (header.compressed) return readLaz(file);
  std::vector<std::byte> records(header.point_count * header.record_length);
  file.readRecords(0, header.point_count, records.data());
  std::vector<double> values;
  for (const LasExtraField& field : file.extraFields())
    decodeLasExtraField(records.data(), header.point_count, header.record_length, field, values);
  takeCensus({path});
}

/// Windows and levels of an octree. A small file may hold many equal points: some are enough.
void readCopc(const std::filesystem::path& path) {
  const LasFile file(path);
  LasWindow coarse;
  coarse.resolution = 10.0;
  file.recordsWithin(coarse);
  for (const double size : {20.0, 400.0, 1e9}) {
    PointWindow window;
    window.bounds.emplace(Eigen::Vector2d(-size, -size), Eigen::Vector2d(size, size));
    if (file.header().point_count > std::uint64_t{1} << 20U) {
      file.recordsWithin({window.bounds, 0.0});
      continue;
    }
    const auto reader = PointReader::open(path, window);
    PointChunk chunk;
    for (int i = 0; i < 4 && reader->read(chunk); ++i) {
    }
  }
}

void readPcd(const std::filesystem::path& path) {
  loadPcd(path);
  takeCensus({path});
}

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

bool las(const std::uint8_t* data, std::size_t size) {
  return readAs(".las", data, size, readLas);
}
bool laz(const std::uint8_t* data, std::size_t size) {
  return readAs(".laz", data, size, readLas);
}
bool damagedLaz(const std::uint8_t* data, std::size_t size) {
  return readAs(".laz", data, size, readIntact);
}
bool copc(const std::uint8_t* data, std::size_t size) {
  return readAs(".laz", data, size, readCopc);
}
bool pcd(const std::uint8_t* data, std::size_t size) {
  return readAs(".pcd", data, size, readPcd);
}
bool trajectoryCsv(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, [](const auto& path) { readTrajectory(path); });
}
bool sbet(const std::uint8_t* data, std::size_t size) {
  return readAs(".sbet", data, size, [](const auto& path) { readTrajectory(path, "EPSG:32611"); });
}
bool control(const std::uint8_t* data, std::size_t size) {
  return readAs(".csv", data, size, [](const auto& path) { readControl(path); });
}
bool calibration(const std::uint8_t* data, std::size_t size) {
  return readAs(".json", data, size, [](const auto& path) { readCalibration(path); });
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

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"las", las, lasSeeds},
      {"laz", laz, lazSeeds},
      {"damaged_laz", damagedLaz, lazSeeds},
      {"copc", copc, copcSeeds},
      {"pcd", pcd, pcdSeeds},
      {"trajectory_csv", trajectoryCsv, trajectorySeeds},
      {"sbet", sbet, sbetSeeds},
      {"control", control, controlSeeds},
      {"calibration", calibration, calibrationSeeds},
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

const Target& targetNamed(const std::string& name) {
  for (const Target& target : targets())
    if (name == target.name) return target;
  std::abort();
}

}  // namespace pcl_als::fuzz
