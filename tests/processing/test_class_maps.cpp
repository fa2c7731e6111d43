// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/raster_io.h>
#include <pcl_als/processing/class_maps.h>

#include "test_files.h"

namespace pcl_als::app {
namespace {

namespace fs = std::filesystem;

CodeRaster mapOf(int columns, int rows, const std::vector<CodeMeaning>& legend) {
  CodeRaster map;
  map.grid = {512000.0, 5403000.0, 1.0, columns, rows, "EPSG:25832"};
  map.values.assign(map.grid.cells(), CodeRaster::kNoClass);
  map.legend = legend;
  return map;
}

// The second map lacks grass, so soil has another code in it; "moor" brings grass's colour along.
TEST(ClassMaps, SameNamesHaveTheSameCodeAndColour) {
  const fs::path folder = test::scratch("class_maps");
  CodeRaster first =
      mapOf(4, 1, {{1, "tree", {0, 100, 0}}, {2, "grass", {9, 200, 9}}, {3, "soil", {150, 90, 0}}});
  first.values = {1, 2, 3, 0};
  writeCodeRaster(folder / "first.tif", first);
  CodeRaster second =
      mapOf(4, 1, {{1, "soil", {150, 90, 0}}, {2, "tree", {0, 100, 0}}, {3, "moor", {9, 200, 9}}});
  second.values = {2, 3, 1, 0};
  writeCodeRaster(folder / "second.tif", second);
  const ClassMaps maps =
      readClassMaps({{"before", folder / "first.tif"}, {"after", folder / "second.tif"}}, 100);
  ASSERT_EQ(maps.legend.size(), 4U);
  EXPECT_EQ(maps.maps[0].values, (std::vector<std::uint8_t>{1, 2, 3, 0}));
  EXPECT_EQ(maps.maps[1].values, (std::vector<std::uint8_t>{1, 4, 3, 0}));
  EXPECT_EQ(maps.legend[3].name, "moor");
  EXPECT_EQ(maps.legend[1].colour, (std::array<std::uint8_t, 3>{9, 200, 9}));
  EXPECT_NE(maps.legend[3].colour, maps.legend[1].colour);
}

// 400 x 300 cells at most 100 wide: a quarter, each cell the commonest of 4 x 4.
TEST(ClassMaps, LargeMapsAreReducedToTheCommonestClass) {
  const fs::path folder = test::scratch("class_maps_large");
  CodeRaster map = mapOf(400, 300, {{1, "tree", {0, 100, 0}}, {2, "soil", {150, 90, 0}}});
  for (int row = 0; row < 300; ++row)
    for (int column = 0; column < 400; ++column)
      map.values[map.grid.index(column, row)] = column % 4 == 0 ? 1 : (column < 200 ? 1 : 2);
  RasterOptions plain;
  plain.overviews = plain.cloud_optimised = false;
  writeCodeRaster(folder / "a.tif", map, plain);
  const CodeRaster reduced = readClassMaps({{"", folder / "a.tif"}}, 100).maps.front();
  EXPECT_EQ(reduced.grid.columns, 100);
  EXPECT_EQ(reduced.grid.rows, 75);
  EXPECT_EQ(reduced.grid.cell, 4.0);
  std::size_t wrong = 0;
  for (int row = 0; row < 75; ++row)
    for (int column = 0; column < 100; ++column)
      wrong += reduced.values[reduced.grid.index(column, row)] != (column < 50 ? 1 : 2);
  EXPECT_EQ(wrong, 0U);
}

TEST(ClassMaps, AMapWithoutNamesIsRefused) {
  const fs::path folder = test::scratch("class_maps_bare");
  writeCodeRaster(folder / "bare.tif", mapOf(3, 2, {}));
  const auto message = [&](const char* name) {
    return test::messageOf<InputError>([&] { requireClassMap(folder / name); });
  };
  EXPECT_NE(message("bare.tif").find("bare.tif: has no names of classes"), std::string::npos);
  EXPECT_NE(message("none.tif").find("there is no such file"), std::string::npos);
  EXPECT_NE(test::messageOf<InputError>([&] {
              readClassMaps({{"", folder / "bare.tif"}}, 100);
            }).find("has no names of classes"),
            std::string::npos);
}

}  // namespace
}  // namespace pcl_als::app
