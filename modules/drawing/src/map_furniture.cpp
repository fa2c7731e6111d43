// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/drawing/map_furniture.h>
#include <pcl_als/drawing/ticks.h>

namespace pcl_als {
namespace {

constexpr double kRowFactor = 1.5;  // line spacing over text size

}  // namespace

Eigen::Vector2d legendSize(const std::vector<LegendEntry>& entries, const std::string& heading,
                           double text_size) {
  TextStyle style;
  style.size = text_size;
  double width = 0.0;
  for (const LegendEntry& entry : entries) {
    width = std::max(width, 1.8 * text_size + Canvas::textSize(entry.name, style).x());
  }
  style.bold = true;
  width = std::max(width, Canvas::textSize(heading, style).x());
  const double rows = static_cast<double>(entries.size()) + (heading.empty() ? 0.0 : 1.2);
  return {width, rows * kRowFactor * text_size};
}

void drawLegend(Canvas& canvas, const std::vector<LegendEntry>& entries, const std::string& heading,
                const Eigen::Vector2d& corner, double text_size) {
  TextStyle style;
  style.size = text_size;
  const double row = kRowFactor * text_size;
  double y = corner.y() + 0.5 * row;
  if (!heading.empty()) {
    TextStyle bold = style;
    bold.bold = true;
    canvas.text(heading, {corner.x(), y}, bold);
    y += 1.2 * row;
  }
  for (const LegendEntry& entry : entries) {
    const PixelBox swatch{corner.x(), std::round(y - 0.5 * text_size), text_size, text_size};
    if (entry.line) {
      canvas.fill({swatch.x, y - 1.5, 1.3 * text_size, 3.0}, entry.color);
    } else {
      canvas.fill(swatch, entry.color);
      canvas.frame(swatch, 1.0, ink::black.withAlpha(90));
    }
    canvas.text(entry.name, {corner.x() + 1.8 * text_size, y}, style);
    y += row;
  }
}

void drawColorBar(Canvas& canvas, const ColorMap& map, double low, double high,
                  const std::string& heading, const PixelBox& box) {
  Image scale(1, std::max(1, static_cast<int>(box.height)));
  for (int i = 0; i < scale.height; ++i) scale.at(0, i) = map(1.0 - (i + 0.5) / scale.height);
  canvas.draw(scale, box);
  canvas.frame(box, 1.0, ink::black.withAlpha(120));
  TextStyle style;
  style.bold = true;
  style.vertical = Align::high;
  canvas.text(heading, {box.x, box.y - 10.0}, style);
  style.bold = false;
  style.vertical = Align::center;
  const Ticks ticks = niceTicks(low, high, std::max(3, static_cast<int>(box.height / 40.0)));
  for (const double value : ticks.values) {
    const double y = box.bottom() - (value - low) / (high - low) * box.height;
    canvas.line({box.right(), y}, {box.right() + 5.0, y}, 1.0, ink::black);
    canvas.text(ticks.label(value), {box.right() + 9.0, y}, style);
  }
}

PixelBox drawScaleBar(Canvas& canvas, double metres_per_pixel, double most_pixels,
                      const Eigen::Vector2d& corner) {
  const double metres = roundDown125(most_pixels * metres_per_pixel);
  const PixelBox bar{corner.x(), corner.y() - 7.0, metres / metres_per_pixel, 7.0};
  canvas.fill(bar, ink::white);
  canvas.frame(bar, 1.0, ink::black);
  canvas.fill({bar.x, bar.y, 0.5 * bar.width, bar.height}, ink::black);
  TextStyle style;
  style.vertical = Align::high;
  canvas.text(lengthText(metres), {bar.x, bar.y - 4.0}, style);
  return bar;
}

void drawNorthArrow(Canvas& canvas, const Eigen::Vector2d& center, double length,
                    const Eigen::Vector2d& direction) {
  const Eigen::Vector2d up = direction.normalized(), right(-up.y(), up.x());
  const Eigen::Vector2d tip = center + 0.5 * length * up, tail = center - 0.5 * length * up;
  const Eigen::Vector2d notch = center - 0.28 * length * up;
  canvas.polygon({tip, tail + 0.3 * length * right, notch}, ink::black);
  canvas.polygon({tip, tail - 0.3 * length * right, notch}, ink::white);
  canvas.polyline({tip, tail - 0.3 * length * right, notch, tail + 0.3 * length * right, tip}, 1.2,
                  ink::black);
  TextStyle style;
  style.bold = true;
  style.horizontal = style.vertical = Align::center;
  canvas.text("N", tip + 11.0 * up, style);
}

void drawCoordinates(Canvas& canvas, const Eigen::Vector2d& north_west, double metres_per_pixel,
                     const PixelBox& box) {
  TextStyle style;
  style.size = 12.0;
  style.color = ink::gray;
  const double west = north_west.x(), north = north_west.y();
  const double east = west + box.width * metres_per_pixel;
  const double south = north - box.height * metres_per_pixel;
  style.horizontal = Align::center;
  style.vertical = Align::low;
  const Ticks across = niceTicks(west, east, std::max(2, static_cast<int>(box.width / 110.0)));
  for (const double value : across.values) {
    const double x = box.x + (value - west) / metres_per_pixel;
    canvas.line({x, box.bottom()}, {x, box.bottom() + 5.0}, 1.0, ink::gray);
    canvas.text(across.label(value), {x, box.bottom() + 7.0}, style);
  }
  style.horizontal = Align::high;
  style.vertical = Align::center;
  const Ticks up = niceTicks(south, north, std::max(2, static_cast<int>(box.height / 60.0)));
  for (const double value : up.values) {
    const double y = box.y + (north - value) / metres_per_pixel;
    canvas.line({box.x - 5.0, y}, {box.x, y}, 1.0, ink::gray);
    canvas.text(up.label(value), {box.x - 8.0, y}, style);
  }
}

}  // namespace pcl_als
