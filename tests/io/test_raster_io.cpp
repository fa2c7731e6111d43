// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/raster_io.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUtm = "EPSG:25832";

std::size_t filesIn(const fs::path& folder) {
  const auto files = fs::directory_iterator(folder);
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

/// A value that tells the cell: exact in float.
float cellValue(std::size_t band, int column, int row) {
  return static_cast<float>(band * 4096.0 + column + row * 0.25);
}

Raster numbered(int columns, int rows, const std::string& crs = kUtm) {
  Raster raster;
  raster.grid = {512000.5, 5403000.0, 0.5, columns, rows, crs};
  for (const char* name : {"height", "intensity"}) {
    const std::size_t band = raster.bands.size();
    RasterBand& values = raster.addBand(name);
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        values.values[raster.grid.index(column, row)] = cellValue(band, column, row);
  }
  return raster;
}

void expectEqual(const Raster& a, const Raster& b) {
  EXPECT_TRUE(a.grid.sameCells(b.grid));
  EXPECT_EQ(a.grid.crs, b.grid.crs);
  ASSERT_EQ(a.bands.size(), b.bands.size());
  for (std::size_t i = 0; i < a.bands.size(); ++i) {
    EXPECT_EQ(a.bands[i].name, b.bands[i].name);
    std::size_t different = 0;
    for (std::size_t cell = 0; cell < a.grid.cells(); ++cell) {
      const float u = a.bands[i].values[cell], v = b.bands[i].values[cell];
      different += !(u == v || (std::isnan(u) && std::isnan(v)));
    }
    EXPECT_EQ(different, 0U) << "band " << i;
  }
}

TEST(RasterGrid, CoversABoxWithEdgesThatAreMultiplesOfTheCell) {
  const RasterGrid grid = RasterGrid::covering(10.1, 20.0, 12.0, 21.4, 0.5, kUtm);
  EXPECT_EQ(grid.west, 10.0);
  EXPECT_EQ(grid.north, 21.5);
  EXPECT_EQ(grid.columns, 5);  // x = 12.0 belongs to the cell east of it
  EXPECT_EQ(grid.rows, 4);     // y = 20.0 to the cell south of it
  EXPECT_TRUE(grid.holds(grid.columnOf(12.0), grid.rowOf(20.0)));
  EXPECT_EQ(grid.centreX(0), 10.25);
  EXPECT_EQ(grid.centreY(3), 19.75);
}

TEST(RasterGrid, RefusesWhatGivesNoGrid) {
  EXPECT_NE(
      test::messageOf<Error>([] { RasterGrid::covering(0, 0, 1, 1, 0.0); }).find("cell size 0"),
      std::string::npos);
  EXPECT_NE(
      test::messageOf<Error>([] { RasterGrid::covering(0, 0, 1e9, 1, 0.01); }).find("too many"),
      std::string::npos);
  EXPECT_NE(test::messageOf<Error>([] { RasterGrid::covering(1, 0, 0, 1, 1.0); }).find("box"),
            std::string::npos);
}

TEST(RasterIo, ComesBackAsItWas) {
  const fs::path folder = test::scratch("raster_back");
  Raster raster = numbered(37, 23);
  raster.bands[0].values[5] = RasterBand::kNoValue;
  writeRaster(folder / "a.tif", raster);
  expectEqual(readRaster(folder / "a.tif"), raster);
  EXPECT_EQ(filesIn(folder), 1U);  // no second file beside it
}

TEST(RasterIo, KeepsACrsOfWktAndNone) {
  const fs::path folder = test::scratch("raster_crs");
  writeRaster(folder / "none.tif", numbered(3, 2, ""));
  EXPECT_EQ(readRaster(folder / "none.tif").grid.crs, "");
  const std::string local = R"(LOCAL_CS["quarry",UNIT["metre",1]])";
  writeRaster(folder / "wkt.tif", numbered(3, 2, local));
  EXPECT_NE(readRaster(folder / "wkt.tif").grid.crs.find("quarry"), std::string::npos);
}

/// Whether the bytes of a double are in a file, as tags of a GeoTIFF keep them.
bool holdsNumber(const fs::path& path, double number) {
  const std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
  return test::readBytes(path).find(bytes) != std::string::npos;
}

TEST(RasterIo, IsGeoreferencedInTheUnitOfItsCrs) {
  const fs::path folder = test::scratch("raster_feet");
  const double foot = 12.0 / 39.37;
  for (const std::string& crs :
       {std::string("EPSG:2271"), crsInUnit("EPSG:32128", lengthUnitOf(foot)),
        localCrs(lengthUnitOf(foot))}) {
    const Raster raster = numbered(37, 23, crs);
    writeRaster(folder / "feet.tif", raster);
    // Scale and corner of the file: EPSG:2271 and the others count in US survey feet.
    EXPECT_TRUE(holdsNumber(folder / "feet.tif", 0.5 / foot)) << crs;
    EXPECT_TRUE(holdsNumber(folder / "feet.tif", 512000.5 / foot)) << crs;
    const RasterGrid grid = readRaster(folder / "feet.tif").grid;
    EXPECT_DOUBLE_EQ(grid.cell, 0.5) << crs;
    EXPECT_DOUBLE_EQ(grid.west, raster.grid.west) << crs;
    EXPECT_DOUBLE_EQ(grid.north, raster.grid.north) << crs;
    EXPECT_TRUE(sameGroundFrame(grid.crs, crs)) << grid.crs;
    EXPECT_DOUBLE_EQ(unitsOfCrs(grid.crs).horizontal.metres, foot) << grid.crs;
  }
}

TEST(RasterIo, HasOverviewsOfMeansAndIsCloudOptimised) {
  const fs::path folder = test::scratch("raster_overviews");
  writeRaster(folder / "a.tif", numbered(1100, 700));
  const RasterReader reader(folder / "a.tif");
  EXPECT_EQ(reader.overviews(), 3);  // 550, 275, 138 columns
  // The header of a cloud-optimised GeoTIFF says so in its first bytes.
  EXPECT_NE(test::readBytes(folder / "a.tif").substr(0, 400).find("LAYOUT=IFDS_BEFORE_DATA"),
            std::string::npos);
  RasterOptions plain;
  plain.overviews = plain.cloud_optimised = false;
  writeRaster(folder / "b.tif", numbered(1100, 700), plain);
  EXPECT_EQ(RasterReader(folder / "b.tif").overviews(), 0);
  expectEqual(readRaster(folder / "b.tif"), readRaster(folder / "a.tif"));
}

TEST(RasterIo, TakesBlocksInAnyOrderAndLeavesTheRestEmpty) {
  const fs::path folder = test::scratch("raster_blocks");
  const Raster raster = numbered(90, 70);
  {
    RasterWriter writer(folder / "a.tif", {raster.grid, {}, {"height"}, {}, -9999.0, {}});
    const std::vector<float> late{1, 2, 3, 4, 5, 6}, early{7};
    writer.write(0, {60, 50, 3, 2}, late.data());
    writer.write(0, {2, 1, 1, 1}, early.data());
    EXPECT_FALSE(fs::exists(folder / "a.tif"));
    writer.commit();
  }
  RasterReader reader(folder / "a.tif");
  std::vector<float> values(6);
  reader.read(0, {60, 50, 3, 2}, values.data());
  EXPECT_EQ(values, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  reader.read(0, {2, 1, 2, 1}, values.data());
  EXPECT_EQ(values[0], 7.0F);
  EXPECT_TRUE(std::isnan(values[1]));
}

TEST(RasterIo, ClassesKeepNamesAndColours) {
  const fs::path folder = test::scratch("raster_classes");
  CodeRaster map;
  map.grid = {85000.0, 447000.0, 1.0, 4, 2, "EPSG:28992"};
  map.values = {1, 2, 2, 0, 1, 1, 2, 0};
  map.legend = {{1, "tree", {0, 100, 0}}, {2, "built-up", {200, 30, 40}}};
  writeCodeRaster(folder / "a.tif", map);
  const CodeRaster back = readCodeRaster(folder / "a.tif");
  EXPECT_EQ(back.values, map.values);
  EXPECT_EQ(back.grid.crs, "EPSG:28992");
  ASSERT_EQ(back.legend.size(), 2U);
  EXPECT_EQ(back.legend[1].name, "built-up");
  EXPECT_EQ(back.legend[1].colour, map.legend[1].colour);
  EXPECT_TRUE(std::isnan(readRaster(folder / "a.tif").bands[0].values[3]));  // 0 is no data
  EXPECT_EQ(filesIn(folder), 1U);
}

TEST(RasterIo, TheFileDoesNotDependOnTheThreads) {
  const fs::path folder = test::scratch("raster_threads");
  RasterOptions options;
  for (const int threads : {1, 4}) {
    options.threads = threads;
    writeRaster(folder / (std::to_string(threads) + ".tif"), numbered(1300, 900), options);
  }
  EXPECT_EQ(test::readBytes(folder / "1.tif"), test::readBytes(folder / "4.tif"));
}

TEST(RasterIo, WithoutCommitTheOldFileStays) {
  const fs::path folder = test::scratch("raster_dropped");
  test::writeBytes(folder / "a.tif", "old");
  { RasterWriter writer(folder / "a.tif", {numbered(9, 9).grid, {}, {"a"}, {}, -9999.0, {}}); }
  EXPECT_EQ(test::readBytes(folder / "a.tif"), "old");
  EXPECT_EQ(filesIn(folder), 1U);
}

TEST(RasterIo, RefusesWithOneLine) {
  const fs::path folder = test::scratch("raster_refused");
  const auto writing = [&](const Raster& raster, const fs::path& path) {
    return test::messageOf<Error>([&] { writeRaster(path, raster); });
  };
  EXPECT_NE(writing(numbered(2, 2, "EPSG:1"), folder / "a.tif").find("EPSG:1 is not known"),
            std::string::npos);
  EXPECT_NE(writing(numbered(2, 2), folder / "no" / "a.tif").find("folder does not exist"),
            std::string::npos);
  Raster few = numbered(2, 2);
  few.bands[1].values.pop_back();
  EXPECT_NE(writing(few, folder / "a.tif").find("intensity: has 3 values for 4"),
            std::string::npos);
  test::writeBytes(folder / "text.tif", "no raster");
  EXPECT_NE(test::messageOf<Error>([&] { readRaster(folder / "text.tif"); }).find("is no GeoTIFF"),
            std::string::npos);
  EXPECT_NE(test::messageOf<Error>([&] {
              readRaster(folder / "none.tif");
            }).find("there is no such file"),
            std::string::npos);
  RasterReader reader((writeRaster(folder / "b.tif", numbered(4, 4)), folder / "b.tif"));
  std::vector<float> values(32);
  EXPECT_NE(test::messageOf<Error>([&] {
              reader.read(0, {2, 0, 3, 1}, values.data());
            }).find("window"),
            std::string::npos);
  EXPECT_EQ(filesIn(folder), 2U);
}

TEST(RasterIo, ATruncatedFileIsAnErrorAndNoCrash) {
  const fs::path folder = test::scratch("raster_cut");
  writeRaster(folder / "a.tif", numbered(600, 600));
  const std::string whole = test::readBytes(folder / "a.tif");
  std::size_t refused = 0;
  for (std::size_t part = 1; part < 8; ++part) {
    test::writeBytes(folder / "cut.tif", whole.substr(0, whole.size() * part / 8));
    refused += test::messageOf<Error>([&] { readRaster(folder / "cut.tif"); }) != "no error";
  }
  EXPECT_EQ(refused, 7U);
}

/// A GeoTIFF in which tags of the first directory have other values.
std::string withTags(std::string bytes, const std::map<std::uint16_t, std::uint32_t>& values) {
  const auto u16 = [&](std::size_t at) {
    std::uint16_t value = 0;
    std::memcpy(&value, &bytes[at], sizeof value);
    return value;
  };
  std::uint32_t directory = 0;
  std::memcpy(&directory, &bytes[4], sizeof directory);
  for (std::size_t i = 0; i < u16(directory); ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    const auto found = values.find(u16(entry));
    if (found == values.end()) continue;
    const std::uint16_t as_u32 = 4;
    std::memcpy(&bytes[entry + 2], &as_u32, sizeof as_u32);
    std::memcpy(&bytes[entry + 8], &found->second, sizeof found->second);
  }
  return bytes;
}

constexpr std::uint16_t kColumns = 256, kRows = 257, kSamples = 277;

// A header may promise anything; the answer is one line and no attempt to have the memory.
TEST(RasterIo, AHeaderThatPromisesTooMuchIsRefused) {
  const fs::path folder = test::scratch("raster_lying");
  RasterOptions plain;
  plain.overviews = plain.cloud_optimised = plain.compress = false;
  writeRaster(folder / "a.tif", numbered(20, 10), plain);
  const std::string good = test::readBytes(folder / "a.tif");
  ASSERT_EQ(good.substr(0, 4), std::string("II*\0", 4));  // a small classic TIFF
  const std::pair<std::uint32_t, std::uint32_t> sizes[] = {
      {20, 2000000000}, {2000000000, 2000000000}, {4294967295U, 1}, {0, 10}, {400000, 400000}};
  for (const auto& [columns, rows] : sizes) {
    test::writeBytes(folder / "lie.tif", withTags(good, {{kColumns, columns}, {kRows, rows}}));
    for (const auto& read :
         {std::function<void()>([&] { readRaster(folder / "lie.tif"); }),
          std::function<void()>([&] { readCodeRaster(folder / "lie.tif", 99); })}) {
      const std::string message = test::messageOf<InputError>(read);
      EXPECT_NE(message.find("lie.tif: "), std::string::npos) << columns << " x " << rows;
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
  }
  test::writeBytes(folder / "same.tif", withTags(good, {{kColumns, 20}, {kRows, 10}}));
  expectEqual(readRaster(folder / "same.tif"), numbered(20, 10));
}

// 2026-11-21, found by fuzz_geotiff: 65535 bands cell by cell are 17 GB for one block.
TEST(RasterIo, AHeaderThatPromisesTooManyBandsIsRefused) {
  const fs::path folder = test::scratch("raster_lying_bands");
  CodeRaster map;
  map.grid = numbered(30, 5).grid;
  map.values.assign(map.grid.cells(), 2);
  writeCodeRaster(folder / "a.tif", map);
  test::writeBytes(folder / "lie.tif",
                   withTags(test::readBytes(folder / "a.tif"), {{kSamples, 65535}}));
  EXPECT_NE(
      test::messageOf<InputError>([&] { RasterReader(folder / "lie.tif"); }).find("blocks of"),
      std::string::npos);
}

/// Runs in a child process: file size limit instead of a full disk, no privileges needed.
void writeOverTheLimit(const fs::path& path, bool cloud_optimised) {
  const rlimit limit{40000, 40000};
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, SIG_IGN);
  RasterOptions options;
  options.cloud_optimised = cloud_optimised;
  options.threads = 1;  // a forked process has none of GDAL's worker threads
  const std::string message =
      test::messageOf<Error>([&] { writeRaster(path, numbered(600, 600), options); });
  // GDAL's words name the temporary file that it works on; a user knows the final one.
  const bool named = message.find("out.tif: ") != std::string::npos &&
                     message.find(".partial") == std::string::npos;
  if (!named) std::cerr << message << '\n';
  _exit(named ? 0 : 1);
}

TEST(RasterIo, AWriteThatFailsIsAnErrorAndLeavesNothing) {
  const fs::path folder = test::scratch("raster_limit");
  for (const bool cloud_optimised : {false, true}) {
    const pid_t child = fork();
    if (child == 0) writeOverTheLimit(folder / "out.tif", cloud_optimised);
    int status = 1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(fs::is_empty(folder));
  }
}

}  // namespace
}  // namespace pcl_als
