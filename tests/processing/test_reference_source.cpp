// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Reference surfaces from GeoTIFF.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/raster_io.h>
#include <pcl_als/processing/reference_source.h>

#include "test_files.h"

namespace pcl_als {
namespace {

/// 4 x 3 cells; the height of a cell is 100 m + column + 10 row, and one cell has none.
std::filesystem::path rasterFile(double cell, const std::string& crs = "EPSG:25832") {
  Raster raster;
  raster.grid.west = 500000.0;
  raster.grid.north = 5600000.0;
  raster.grid.cell = cell;
  raster.grid.columns = 4;
  raster.grid.rows = 3;
  raster.grid.crs = crs;
  RasterBand& band = raster.addBand("height");
  for (std::size_t i = 0; i < 12; ++i)
    band.values[i] = 100.0F + static_cast<float>(i % 4) + 10.0F * static_cast<float>(i / 4);
  band.values[5] = RasterBand::kNoValue;
  const auto path = test::scratch("reference_source") / "dem.tif";
  writeRaster(path, raster);
  return path;
}

std::vector<Eigen::Vector3d> read(const ReferenceSource& source, double east) {
  std::vector<Eigen::Vector3d> points;
  const Eigen::AlignedBox2d box(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(east, 1e7));
  source.read(box, [&](const LidarReturn* p, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) points.push_back(p[i].position);
  });
  return points;
}

TEST(ReferenceSource, HasThePointsOfTheCells) {
  const auto points = read(openReference(rasterFile(2.0).string()), 1e7);
  ASSERT_EQ(points.size(), 11U);
  EXPECT_TRUE(points[0].isApprox(Eigen::Vector3d(500001.0, 5599999.0, 100.0), 1e-12));
  EXPECT_TRUE(points[10].isApprox(Eigen::Vector3d(500007.0, 5599995.0, 123.0), 1e-12));
}

TEST(ReferenceSource, IsReadInsideABoxOnly) {
  const auto path = rasterFile(2.0);
  EXPECT_EQ(read(openReference(path.string()), 500003.0).size(), 5U);
  EXPECT_TRUE(read(openReference(path.string()), 400000.0).empty());
}

TEST(ReferenceSource, TakesStandardDeviationsFromItsText) {
  const std::string path = rasterFile(2.0).string();
  EXPECT_EQ(openReference(path).surface.std, 0.02);
  const ReferenceSource stated = openReference(path + ":0.05:0.3");
  EXPECT_EQ(stated.surface.name, "dem.tif");
  EXPECT_EQ(stated.surface.std, 0.05);
  EXPECT_EQ(stated.surface.offset, 0.3);
  EXPECT_EQ(stated.info.crs, "EPSG:25832");
}

TEST(ReferenceSource, RefusesWhatIsNoSurface) {
  EXPECT_THROW(openReference(rasterFile(25.0).string()), InputError);
  EXPECT_THROW(openReference("missing.tif"), InputError);
  EXPECT_THROW(openReference("missing.laz:0.05"), InputError);
}

}  // namespace
}  // namespace pcl_als
