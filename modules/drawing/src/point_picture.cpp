// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/map_furniture.h>
#include <pcl_als/drawing/point_picture.h>
#include <pcl_als/drawing/ticks.h>

#include "plot_parts.h"

namespace pcl_als {
namespace {

constexpr double kMargin = 24.0, kPanel = 210.0, kLeft = 100.0, kFoot = 44.0;

/// Direction of grid north in the picture, x right and y down; zero when towards the camera.
Eigen::Vector2d northIn(const OrthographicCamera& camera) {
  const Eigen::Vector3d north(0.0, 1.0, 0.0);
  return {camera.right().dot(north), -camera.up().dot(north)};
}

std::string viewText(const OrthographicCamera& camera) {
  if (camera.elevation() == 90.0) return "top view";
  return "looking to " + numberText(camera.azimuth(), 0) + "°, " +
         numberText(camera.elevation(), 0) + "° down";
}

bool anyWithoutValue(const PixelThinning& points) {
  return std::any_of(points.pixels().begin(), points.pixels().end(),
                     [](const PixelThinning::Shown& p) { return p.used() && std::isnan(p.value); });
}

}  // namespace

Color PointColoring::operator()(float value) const {
  if (std::isnan(value)) return no_value_color;
  if (categories.empty()) return map((value - low) / (high - low));
  for (const Category& category : categories) {
    if (category.value == value) return category.color;
  }
  return no_value_color;
}

void PointColoring::fitScale(const PixelThinning& points, double p, bool symmetric) {
  std::vector<float> values;
  for (const PixelThinning::Shown& pixel : points.pixels()) {
    if (!pixel.used() || !std::isfinite(pixel.value)) continue;
    values.push_back(symmetric ? std::abs(pixel.value) : pixel.value);
  }
  if (values.empty()) return;
  const auto quantile = [&](double share) {
    const auto at =
        values.begin() +
        static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
  };
  high = quantile(1.0 - p);
  low = symmetric ? -high : quantile(p);
  if (high - low > 1e-6 * std::max(1.0, std::abs(high))) return;
  const double middle = 0.5 * (low + high);
  low = middle - 0.5;
  high = middle + 0.5;
}

void PointColoring::keepShown(const PixelThinning& points) {
  std::vector<bool> used(categories.size(), false);
  for (const PixelThinning::Shown& pixel : points.pixels()) {
    if (!pixel.used()) continue;
    for (std::size_t i = 0; i < categories.size(); ++i) {
      if (categories[i].value == pixel.value) used[i] = true;
    }
  }
  std::vector<Category> kept;
  for (std::size_t i = 0; i < categories.size(); ++i) {
    if (used[i]) kept.push_back(categories[i]);
  }
  categories = std::move(kept);
}

double closingPointSize(const PixelThinning& points) {
  // Share of used pixels in those squares of eight pixels that hold any.
  constexpr int kSquare = 8;
  const int width = points.camera().width(), columns = (width + kSquare - 1) / kSquare;
  const int rows = (points.camera().height() + kSquare - 1) / kSquare;
  std::vector<int> counts(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  for (std::size_t i = 0; i < points.pixels().size(); ++i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    if (points.pixels()[i].used())
      ++counts[static_cast<std::size_t>(y / kSquare * columns + x / kSquare)];
  }
  double used = 0.0, squares = 0.0;
  for (const int count : counts) {
    used += count;
    squares += count > 0 ? 1.0 : 0.0;
  }
  if (used == 0.0) return 1.0;
  if (squares < 20.0) return 5.0;  // so few points that they are to be found
  const double fill = used / (squares * kSquare * kSquare);
  return std::clamp(std::ceil(std::sqrt(1.0 / fill) - 0.02), 1.0, 5.0);
}

PointPicture::PointPicture(int width, int height, bool bare)
    : width_(width), height_(height), bare_(bare) {
  const int least_x = bare ? 1 : 480, least_y = bare ? 1 : 320;
  if (width < least_x || height < least_y || width > 16384 || height > 16384) {
    throw UsageError("a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                     " pixels: must be " + std::to_string(least_x) + "x" + std::to_string(least_y) +
                     " to 16384x16384");
  }
  const double top = 70.0;
  map_ = bare ? PixelBox{0.0, 0.0, static_cast<double>(width), static_cast<double>(height)}
              : PixelBox{kLeft, top, width - kLeft - kPanel - 2.0 * kMargin, height - top - kFoot};
}

Image PointPicture::rasterise(const PixelThinning& points, const PointColoring& coloring) const {
  const int width = points.camera().width(), height = points.camera().height();
  const double size = point_size_ > 0.0 ? point_size_ : closingPointSize(points);
  const int reach = static_cast<int>(std::ceil(size)) + 1;
  std::vector<float> brightness;
  if (shade_ == PointShade::eye_dome) brightness = eyeDomeShade(points, reach);
  if (shade_ == PointShade::hill) brightness = hillShade(points, reach);
  Image image(width, height, background_);
  std::vector<float> depths(image.pixels.size(), -std::numeric_limits<float>::infinity());
  // A point covers the pixels whose centres are in a square around the centre of its own.
  const int before = static_cast<int>(std::ceil(0.5 * size - 0.5)),
            after = static_cast<int>(std::ceil(size)) - 1 - before;
  for (std::size_t i = 0; i < points.pixels().size(); ++i) {
    const PixelThinning::Shown& point = points.pixels()[i];
    if (!point.used()) continue;
    const Color own = coloring(point.value);
    const Color color = brightness.empty() ? own : mix(ink::black, own, brightness[i]);
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    for (int row = std::max(0, y - before); row <= std::min(height - 1, y + after); ++row) {
      for (int column = std::max(0, x - before); column <= std::min(width - 1, x + after);
           ++column) {
        float& depth = depths[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(column)];
        if (point.depth < depth) continue;
        depth = point.depth;
        image.at(column, row) = color;
      }
    }
  }
  return image;
}

Canvas PointPicture::draw(const PixelThinning& points, const PointColoring& coloring) const {
  const OrthographicCamera& camera = points.camera();
  Canvas canvas(width_, height_);
  canvas.draw(rasterise(points, coloring), map_);
  if (bare_) return canvas;
  canvas.frame({map_.x - 1.0, map_.y - 1.0, map_.width + 2.0, map_.height + 2.0}, 1.0, ink::gray);
  TextStyle style;
  style.size = 20.0;
  style.bold = true;
  const double available = width_ - 2.0 * kMargin;
  canvas.text(detail::shortened(title_, available, style), {kMargin, 24.0}, style);
  style = {};
  style.color = ink::gray;
  const std::string facts = (subtitle_.empty() ? "" : subtitle_ + ", ") + viewText(camera);
  canvas.text(detail::shortened(facts, available, style), {kMargin, 50.0}, style);
  if (camera.isTopView()) {
    const Eigen::Vector2d north_west =
        camera.center().head<2>() +
        camera.metresPerPixel() * Eigen::Vector2d(-0.5 * map_.width, 0.5 * map_.height);
    drawCoordinates(canvas, north_west, camera.metresPerPixel(), map_);
  }
  drawPanel(canvas, points, coloring);
  return canvas;
}

void PointPicture::drawPanel(Canvas& canvas, const PixelThinning& points,
                             const PointColoring& coloring) const {
  const double left = map_.right() + kMargin, top = map_.y;
  const double foot = map_.bottom();  // position of scale bar and arrow
  const double metres = points.camera().metresPerPixel();
  drawScaleBar(canvas, metres, kPanel - 40.0, {left, foot});
  const Eigen::Vector2d north = northIn(points.camera());
  const double available = foot - 150.0 - top;
  // A picture too low for scale and arrow has north up, or states the direction of view.
  if (north.norm() > 0.05 && available > 130.0)
    drawNorthArrow(canvas, {left + 24.0, foot - 92.0}, 46.0, north);
  const bool gaps = anyWithoutValue(points);
  if (coloring.categories.empty()) {
    TextStyle bold;
    bold.bold = true;
    const double height = std::clamp(available - 60.0, 60.0, 420.0);
    drawColorBar(canvas, coloring.map, coloring.low, coloring.high,
                 detail::shortened(coloring.heading, kPanel, bold),
                 {left, top + 28.0, 24.0, height});
    if (gaps) {
      drawLegend(canvas, {{coloring.no_value, coloring.no_value_color}}, "",
                 {left, top + 28.0 + height + 14.0});
    }
    return;
  }
  std::vector<LegendEntry> entries;
  for (const PointColoring::Category& category : coloring.categories) {
    entries.push_back({detail::shortened(category.name, kPanel - 26.0, {}), category.color});
  }
  if (gaps) entries.push_back({coloring.no_value, coloring.no_value_color});
  const auto most = static_cast<std::size_t>(std::max(2.0, available / 21.0 - 2.0));
  if (entries.size() > most) {
    const std::size_t more = entries.size() - most + 1;
    entries.resize(most - 1);
    entries.push_back({"and " + std::to_string(more) + " more", ink::white});
  }
  drawLegend(canvas, entries, coloring.heading, {left, top});
}

}  // namespace pcl_als
