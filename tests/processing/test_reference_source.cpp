// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Reference surfaces from GeoTIFF.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gdal.h>
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

/// Three cells in a row, 2 m, of another type than ours, as other programs write them.
std::filesystem::path rasterOf(GDALDataType type, std::vector<double> values, double no_data,
                               double scale) {
  GDALAllRegister();
  const auto path = test::scratch("reference_types") / "dem.tif";
  const GDALDatasetH file = GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(),
                                       static_cast<int>(values.size()), 1, 1, type, nullptr);
  double transform[6] = {500000.0, 2.0, 0.0, 5600000.0, 0.0, -2.0};
  GDALSetGeoTransform(file, transform);
  const GDALRasterBandH band = GDALGetRasterBand(file, 1);
  GDALSetRasterNoDataValue(band, no_data);
  if (scale != 1.0) GDALSetRasterScale(band, scale);
  const int count = static_cast<int>(values.size());
  EXPECT_EQ(
      GDALRasterIO(band, GF_Write, 0, 0, count, 1, values.data(), count, 1, GDT_Float64, 0, 0),
      CE_None);
  GDALClose(file);
  return path;
}

/// Whole numbers of decimetres, and doubles whose missing value no float can represent.
TEST(ReferenceSource, ReadsIntegersAndDoubles) {
  const auto integers =
      read(openReference(rasterOf(GDT_Int16, {12345, -32768, -57}, -32768.0, 0.1).string()), 1e7);
  ASSERT_EQ(integers.size(), 2U);
  EXPECT_NEAR(integers[0].z(), 1234.5, 1e-4);  // a step of a float at 1235 m is 0.12 mm
  EXPECT_NEAR(integers[1].z(), -5.7, 1e-6);
  EXPECT_NEAR(integers[1].x(), 500005.0, 1e-9);
  for (const double none : {-1.7976931348623157e308, -9999.0, std::nan("")}) {
    const auto doubles = read(
        openReference(rasterOf(GDT_Float64, {1234.5678, none, 2.25}, none, 1.0).string()), 1e7);
    ASSERT_EQ(doubles.size(), 2U) << none;
    EXPECT_NEAR(doubles[0].z(), 1234.5678, 1e-4);
    EXPECT_EQ(doubles[1].z(), 2.25);
  }
}

TEST(ReferenceSource, RefusesWhatIsNoSurface) {
  EXPECT_THROW(openReference(rasterFile(25.0).string()), InputError);
  EXPECT_THROW(openReference("missing.tif"), InputError);
  EXPECT_THROW(openReference("missing.laz:0.05"), InputError);
}

}  // namespace
}  // namespace pcl_als
