// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <functional>

#include <unistd.h>

#include <pcl_als/io/raster_io.h>
#include <pcl_als/processing/class_model_file.h>

#include "fuzz_seeds.h"
#include "las_bytes.h"

namespace pcl_als::fuzz {
namespace {

namespace fs = std::filesystem;

/// The bytes of a file that a function writes.
std::string bytesOf(const std::function<void(const fs::path&)>& write) {
  const fs::path path =
      fs::temp_directory_path() / ("pcl_als_fuzz_seed." + std::to_string(getpid()));
  write(path);
  std::string bytes = test::readBytes(path);
  fs::remove(path);
  return bytes;
}

std::string feature(const std::string& label, const std::string& geometry) {
  return R"({"type":"Feature","properties":{"class":)" + label + R"(},"geometry":)" + geometry +
         "}";
}

#ifdef PCL_ALS_HAVE_GDAL
Raster smallRaster(int columns, int rows, int bands) {
  Raster raster;
  raster.grid = {512000.0, 5403000.0, 0.5, columns, rows, ""};
  for (int band = 0; band < bands; ++band) {
    std::vector<float>& values = raster.addBand("band" + std::to_string(band)).values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 17);
  }
  return raster;
}

CodeRaster smallMap() {
  CodeRaster map;
  map.grid = {85000.0, 447000.0, 1.0, 300, 5, "EPSG:28992"};
  map.values.assign(map.grid.cells(), 2);
  map.legend = {{1, "tree", {0, 100, 0}}, {2, "built-up", {200, 30, 40}}};
  return map;
}
#endif

}  // namespace

std::vector<std::string> geoJsonSeeds() {
  const std::string ring = "[[500,0],[510,0],[510,10],[500,0]]";
  const std::string first = feature("\"grass\"", R"({"type":"Point","coordinates":[512000,5e6]})");
  return {R"({"type":"FeatureCollection","features":[)" + first + "," +
              feature("7", R"({"type":"Polygon","coordinates":[)" + ring + "]}") + "," +
              feature("true", R"({"type":"MultiPolygon","coordinates":[[)" + ring + "]]}") + "]}",
          R"({"features":[)" +
              feature("\"a\"", R"({"type":"MultiPoint","coordinates":[[500,1],[2,3]]})") + "]}"};
}

std::vector<std::string> classSiteSeeds() {
  return {"x,y,class\n512000.5,5403000,tree\n1,2,built-up\n",
          "class;y;x\n\"soil\";2;1\r\ngrass;4;3\r\n"};
}

std::vector<std::string> countTableSeeds() {
  return {"is,tree,soil\ntree,130,40\nsoil,20,61\n",
          "\ta\tb\tc\nb\t0\t0\t0\na\t1\t2\t3\nc\t4\t5\t6\n",
          "is,a,b\na,1000000000000,1000000000000\nb,1000000000000,1000000000000\n"};
}

std::vector<std::string> checkedSiteSeeds() {
  return {"x,y,reference,classified\n1,2,tree,tree\n3,4,soil,\n5.5,6,soil,tree\n",
          "classified;reference;x;y\na;b;1;2\n"};
}

std::vector<std::string> classModelSeeds() {
  GaussianModel model{{"height", "intensity"}, {}};
  for (const char* name : {"tree", "grass"})
    model.classes.push_back({name, Eigen::Vector2d(model.classes.empty() ? 8.0 : 0.5, 50.0),
                             Eigen::Matrix2d(Eigen::Vector2d(2.0, 1e2).asDiagonal()), 0.5, 60,
                             0.0});
  return {bytesOf([&](const fs::path& path) { writeClassModel(path, model, {"a remark"}); })};
}

std::vector<std::string> geoTiffSeeds() {
#ifdef PCL_ALS_HAVE_GDAL
  RasterOptions plain;
  plain.overviews = plain.cloud_optimised = false;
  return {bytesOf([](const fs::path& path) { writeCodeRaster(path, smallMap()); }),
          bytesOf([](const fs::path& path) { writeRaster(path, smallRaster(20, 9, 2)); }),
          bytesOf([&](const fs::path& path) { writeRaster(path, smallRaster(3, 2, 1), plain); })};
#else
  return {};
#endif
}

}  // namespace pcl_als::fuzz
