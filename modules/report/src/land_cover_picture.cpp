// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Pictures of maps with legend, scale and coordinates.
#include <algorithm>

#include <pcl_als/drawing/class_map.h>
#include <pcl_als/report/land_cover_picture.h>

namespace pcl_als {
namespace {

constexpr int kHeight = 1000, kLeastWidth = 700, kMapHeight = 800;
constexpr int kLargestRaster = 8192;  // cells: several under each pixel vote on it

}  // namespace

void drawMaps(const std::filesystem::path& path, const std::vector<TitledMap>& maps) {
  ClassMaps rasters = readClassMaps(maps, kLargestRaster);
  ClassMapPicture picture;
  std::vector<MapClass> classes;
  for (const CodeMeaning& entry : rasters.legend)
    classes.push_back(
        {entry.value, entry.name, {entry.colour[0], entry.colour[1], entry.colour[2]}});
  picture.setClasses(std::move(classes));
  double width = 300.0;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const RasterGrid& grid = rasters.maps[i].grid;
    width += std::min(2.0 * kMapHeight, double(kMapHeight) * grid.columns / grid.rows) + 60.0;
    picture.addMap(maps[i].caption, {grid.columns,
                                     grid.rows,
                                     grid.cell,
                                     {grid.west, grid.north},
                                     std::move(rasters.maps[i].values)});
  }
  picture.draw(std::max(kLeastWidth, static_cast<int>(width)), kHeight).write(path);
}

}  // namespace pcl_als
