// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/class_map.h>
#include <pcl_als/drawing/ticks.h>

namespace pcl_als {
namespace {

constexpr double kMargin = 20.0, kTitle = 44.0, kCaption = 30.0, kLabels = 92.0, kBelow = 66.0;

}  // namespace

void ClassMapPicture::addMap(std::string caption, ClassRaster raster) {
  const auto cells = static_cast<std::size_t>(std::max(0, raster.columns)) *
                     static_cast<std::size_t>(std::max(0, raster.rows));
  if (cells == 0 || raster.codes.size() != cells || !(raster.cell > 0.0)) {
    throw UsageError("class map '" + caption + "': needs one code for each of its " +
                     std::to_string(cells) + " cells, and at least one cell");
  }
  maps_.push_back({std::move(caption), std::move(raster)});
}

Image ClassMapPicture::imageOf(const ClassRaster& raster, double pixels_per_cell) const {
  std::array<int, 256> class_of{};
  class_of.fill(-1);
  for (std::size_t i = 0; i < classes_.size(); ++i)
    class_of[classes_[i].code] = static_cast<int>(i);
  const int width = std::max(1, static_cast<int>(std::lround(raster.columns * pixels_per_cell)));
  const int height = std::max(1, static_cast<int>(std::lround(raster.rows * pixels_per_cell)));
  Image image(width, height, ink::ground);
  std::vector<int> votes(classes_.size());
  const auto cellsUnder = [](int pixel, int pixels, int cells) {
    const int first = static_cast<int>(static_cast<long>(pixel) * cells / pixels);
    return std::make_pair(first,
                          std::max(first + 1, static_cast<int>((pixel + 1L) * cells / pixels)));
  };
  for (int y = 0; y < height; ++y) {
    const auto [top, bottom] = cellsUnder(y, height, raster.rows);
    for (int x = 0; x < width; ++x) {
      const auto [left, right] = cellsUnder(x, width, raster.columns);
      std::fill(votes.begin(), votes.end(), 0);
      for (int row = top; row < bottom; ++row) {
        for (int column = left; column < right; ++column) {
          const std::size_t cell = static_cast<std::size_t>(row) * raster.columns + column;
          const int found = class_of[raster.codes[cell]];
          if (found >= 0) ++votes[static_cast<std::size_t>(found)];
        }
      }
      const auto best = std::max_element(votes.begin(), votes.end());
      if (best != votes.end() && *best > 0) {
        image.at(x, y) = classes_[static_cast<std::size_t>(best - votes.begin())].color;
      }
    }
  }
  return image;
}

void ClassMapPicture::drawMap(Canvas& canvas, const Map& map, const Eigen::Vector2d& corner,
                              double metres_per_pixel) const {
  const Image image = imageOf(map.raster, map.raster.cell / metres_per_pixel);
  const PixelBox box{std::round(corner.x() + kLabels), std::round(corner.y() + kCaption),
                     static_cast<double>(image.width), static_cast<double>(image.height)};
  TextStyle style;
  style.size = 15.0;
  style.bold = true;
  canvas.text(map.caption, {box.x, corner.y() + 0.5 * kCaption}, style);
  canvas.draw(image, box);
  canvas.frame({box.x - 1.0, box.y - 1.0, box.width + 2.0, box.height + 2.0}, 1.0, ink::gray);
  drawCoordinates(canvas, map.raster.north_west, metres_per_pixel, box);
}

std::vector<LegendEntry> ClassMapPicture::legend() const {
  std::vector<LegendEntry> entries;
  for (const MapClass& c : classes_) entries.push_back({c.name, c.color});
  return entries;
}

/// Pixels from west to east that each map may take.
double ClassMapPicture::roomAcross(int width) const {
  const double available =
      width - 3.0 * kMargin - std::max(legendSize(legend(), heading_).x(), 130.0);
  return available / static_cast<double>(maps_.size()) - kLabels - 2.0 * kMargin;
}

int ClassMapPicture::heightFor(int width, int lowest, int highest) const {
  double height = 0.0;
  for (const Map& map : maps_)
    height = std::max(height, roomAcross(width) * map.raster.rows / map.raster.columns);
  height += kMargin + (title_.empty() ? 0.0 : kTitle) + kCaption + kBelow;
  return static_cast<int>(std::clamp<double>(std::ceil(height), lowest, highest));
}

Canvas ClassMapPicture::draw(int width, int height) const {
  if (maps_.empty() || classes_.empty()) throw UsageError("a class map needs a map and classes");
  Canvas canvas(width, height);
  const std::vector<LegendEntry> entries = legend();
  const double top = kMargin + (title_.empty() ? 0.0 : kTitle);
  const double room_x = roomAcross(width), room_y = height - top - kCaption - kBelow;
  if (room_x < 50.0 || room_y < 50.0 || top + legendSize(entries, heading_).y() > height - 150.0) {
    throw UsageError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels is too small for these maps and classes");
  }
  double metres_per_pixel = 0.0;
  for (const Map& map : maps_) {
    metres_per_pixel = std::max({metres_per_pixel, map.raster.columns * map.raster.cell / room_x,
                                 map.raster.rows * map.raster.cell / room_y});
  }
  TextStyle heading;
  heading.size = 20.0;
  heading.bold = true;
  if (!title_.empty()) canvas.text(title_, {kMargin, kMargin + 12.0}, heading);
  double legend_x = kMargin;
  for (const Map& map : maps_) {
    drawMap(canvas, map, {legend_x, top}, metres_per_pixel);
    legend_x += kLabels + map.raster.columns * map.raster.cell / metres_per_pixel + 2.0 * kMargin;
  }
  drawLegend(canvas, entries, heading_, {legend_x, top + kCaption});
  drawScaleBar(canvas, metres_per_pixel, 120.0, {legend_x, height - kBelow});
  drawNorthArrow(canvas, {legend_x + 18.0, height - kBelow - 80.0}, 44.0);
  return canvas;
}

}  // namespace pcl_als
