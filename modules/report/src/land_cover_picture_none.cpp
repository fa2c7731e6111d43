// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Pictures of maps in a build without module visualization: cells only, side by side.
#include <algorithm>

#include <pcl_als/io/raster_io.h>
#include <pcl_als/processing/land_cover.h>
#include <pcl_als/report/land_cover_picture.h>

namespace pcl_als {
namespace {

constexpr int kLargestSide = 2000, kGap = 10;

void paint(const CodeRaster& map, int step, int left, PngImage& image) {
  std::array<std::array<std::uint8_t, 3>, 256> colours{};
  colours.fill({255, 255, 255});
  for (const CodeMeaning& entry : map.legend) colours[entry.value] = entry.colour;
  for (int row = 0; row < map.grid.rows / step; ++row)
    for (int column = 0; column < map.grid.columns / step; ++column) {
      const auto& colour = colours[map.values[map.grid.index(column * step, row * step)]];
      const std::size_t pixel = static_cast<std::size_t>(row) * image.width + left + column;
      std::copy(colour.begin(), colour.end(), &image.pixels[3 * pixel]);
    }
}

}  // namespace

void drawMaps(const std::filesystem::path& path, const std::vector<TitledMap>& maps) {
  const ClassMaps read = readClassMaps(maps, 4 * kLargestSide);
  const std::vector<CodeRaster>& rasters = read.maps;
  int side = 1, width = 0, height = 0;
  for (const CodeRaster& raster : rasters)
    side = std::max({side, raster.grid.columns, raster.grid.rows});
  const int step = (side + kLargestSide - 1) / kLargestSide;
  for (const CodeRaster& raster : rasters) {
    width += raster.grid.columns / step + kGap;
    height = std::max(height, raster.grid.rows / step);
  }
  PngImage image{width - kGap, height, 3, {}};
  image.pixels.assign(static_cast<std::size_t>(image.width) * image.height * 3, 255);
  int left = 0;
  for (const CodeRaster& raster : rasters) {
    paint(raster, step, left, image);
    left += raster.grid.columns / step + kGap;
  }
  writePngImage(path, image);
  std::filesystem::path legend = path;
  legend.replace_filename(path.stem().string() + "_legend.csv");
  writeLegend(legend, read.legend);
}

}  // namespace pcl_als
