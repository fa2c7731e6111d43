// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Pictures of maps with legend, scale and coordinates.
#include <algorithm>

#include <pcl_als/visualization/class_map.h>

#include "land_cover.h"

namespace pcl_als::app {
namespace {

constexpr int kHeight = 1000, kLeastWidth = 700, kMapHeight = 800;

}  // namespace

void drawMaps(const std::filesystem::path& path, const std::vector<TitledMap>& maps) {
  ClassMapPicture picture;
  double width = 300.0;
  bool legend = false;
  for (const TitledMap& map : maps) {
    CodeRaster raster = readCodeRaster(map.raster);
    const RasterGrid& grid = raster.grid;
    if (!legend) {
      std::vector<MapClass> classes;
      for (const CodeMeaning& entry : raster.legend)
        classes.push_back(
            {entry.value, entry.name, {entry.colour[0], entry.colour[1], entry.colour[2]}});
      picture.setClasses(std::move(classes));
      legend = true;
    }
    width += std::min(2.0 * kMapHeight, double(kMapHeight) * grid.columns / grid.rows) + 60.0;
    picture.addMap(
        map.caption,
        {grid.columns, grid.rows, grid.cell, {grid.west, grid.north}, std::move(raster.values)});
  }
  writePng(path, picture.draw(std::max(kLeastWidth, static_cast<int>(width)), kHeight).image());
}

}  // namespace pcl_als::app
