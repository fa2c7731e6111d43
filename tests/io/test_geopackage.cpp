// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <memory>

#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/geopackage.h>

#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

/// A GeoPackage as another program reads it.
class Package {
 public:
  explicit Package(const fs::path& path) {
    GDALAllRegister();
    dataset_ = GDALOpenEx(path.c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr);
  }
  ~Package() { GDALClose(dataset_); }
  Package(const Package&) = delete;
  Package& operator=(const Package&) = delete;

  int tables() const { return GDALDatasetGetLayerCount(dataset_); }
  OGRLayerH table(const char* name) const { return GDALDatasetGetLayerByName(dataset_, name); }
  OGRFieldType typeOf(const char* name, int field) const {
    return OGR_Fld_GetType(OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(table(name)), field));
  }
  std::shared_ptr<void> feature(const char* name, long long id) const {
    return {OGR_L_GetFeature(table(name), id), OGR_F_Destroy};
  }

 private:
  GDALDatasetH dataset_;
};

CodeRaster rasterOf(int columns, int rows, std::vector<std::uint8_t> values) {
  CodeRaster raster;
  raster.grid.west = 100.0;
  raster.grid.north = 200.0;
  raster.grid.cell = 10.0;
  raster.grid.columns = columns;
  raster.grid.rows = rows;
  raster.values = std::move(values);
  return raster;
}

TEST(GeoPackage, HasPlacesAndTypesOfColumns) {
  const fs::path path = test::scratch("geopackage") / "points.gpkg";
  writeGeoPackage(path,
                  {{"offsets",
                    "set,a,x,y,vertical_m\nafter,\"1,2\",350000.5,5330000.25,0.031\n"
                    "after,3,350010.5,5330000.25,\n"},
                   {"empty", "a,b\n"}},
                  "EPSG:32632");
  const Package package(path);
  ASSERT_EQ(package.tables(), 1);
  const OGRLayerH table = package.table("offsets");
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(OGR_L_GetFeatureCount(table, TRUE), 2);
  EXPECT_STREQ(OSRGetAuthorityCode(OGR_L_GetSpatialRef(table), nullptr), "32632");
  EXPECT_EQ(package.typeOf("offsets", 1), OFTString);
  EXPECT_EQ(package.typeOf("offsets", 4), OFTReal);
  const auto first = package.feature("offsets", 1), second = package.feature("offsets", 2);
  EXPECT_STREQ(OGR_F_GetFieldAsString(first.get(), 1), "1,2");
  EXPECT_EQ(OGR_F_GetFieldAsDouble(first.get(), 4), 0.031);
  EXPECT_TRUE(OGR_F_IsFieldNull(second.get(), 4));
  EXPECT_EQ(OGR_G_GetX(OGR_F_GetGeometryRef(first.get()), 0), 350000.5);
  EXPECT_EQ(OGR_G_GetY(OGR_F_GetGeometryRef(first.get()), 0), 5330000.25);
}

// EPSG:2263 counts in US survey feet of 1200/3937 m.
TEST(GeoPackage, GeometriesAreInTheUnitOfTheCrs) {
  const fs::path path = test::scratch("geopackage_feet") / "points.gpkg";
  writeGeoPackage(path, {{"control", "x,y\n300000,60000\nnone,\n"}}, "EPSG:2263");
  const Package package(path);
  const auto first = package.feature("control", 1), second = package.feature("control", 2);
  EXPECT_NEAR(OGR_G_GetX(OGR_F_GetGeometryRef(first.get()), 0), 984250.0, 1e-6);
  EXPECT_EQ(OGR_F_GetGeometryRef(second.get()), nullptr);
}

// A ring of cells of 10 m around a hole, and a cell apart: 9 cells, two parts, one hole.
TEST(GeoPackage, HasOutlinesOfCells) {
  const fs::path path = test::scratch("geopackage_areas") / "areas.gpkg";
  GeoTable table{"strips", "strip,area_m2\nnorth,900\nnothing,0\n"};
  table.areas = {rasterOf(5, 3,
                          {7, 7, 7, 0, 0,  //
                           7, 0, 7, 0, 7,  //
                           7, 7, 7, 0, 0}),
                 rasterOf(1, 1, {0})};
  writeGeoPackage(path, {table}, "");
  const Package package(path);
  const auto strip = package.feature("strips", 1), nothing = package.feature("strips", 2);
  const OGRGeometryH area = OGR_F_GetGeometryRef(strip.get());
  EXPECT_EQ(OGR_G_GetGeometryCount(area), 2);
  EXPECT_DOUBLE_EQ(OGR_G_Area(area), 900.0);
  OGREnvelope box;
  OGR_G_GetEnvelope(area, &box);
  EXPECT_EQ(box.MinX, 100.0);
  EXPECT_EQ(box.MaxX, 150.0);
  EXPECT_EQ(box.MaxY, 200.0);
  EXPECT_EQ(box.MinY, 170.0);
  EXPECT_TRUE(OGR_G_IsEmpty(OGR_F_GetGeometryRef(nothing.get())));
  table.areas.pop_back();
  EXPECT_THROW(writeGeoPackage(path, {table}, ""), UsageError);
}

TEST(GeoPackage, FailsAsAWhole) {
  const fs::path folder = test::scratch("geopackage_fails");
  const std::vector<GeoTable> tables{{"control", "x,y\n1,2\n"}};
  EXPECT_NE(test::messageOf<InputError>([&] {
              writeGeoPackage(folder / "a.gpkg", tables, "EPSG:99999");
            }).find("a.gpkg: the CRS EPSG:99999 is not known to PROJ"),
            std::string::npos);
  EXPECT_THROW(writeGeoPackage(folder / "nowhere" / "a.gpkg", tables, ""), InputError);
  EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace pcl_als
