// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/axes.h>
#include <pcl_als/drawing/row_plots.h>

#include "plot_parts.h"

namespace pcl_als {
namespace {

using detail::kNormal95;
using detail::kPlotMargin;

constexpr double kAxisHeight = 84.0;

double shownValue(const BeforeAfterPlot::Row& row) {
  return std::isfinite(row.after) ? row.after : row.before;
}

Axis rowAxis(std::size_t rows) {
  Axis y;
  y.high = static_cast<double>(rows);
  y.ticks = false;
  return y;
}

/// Names as large as the rows allow, right-aligned.
TextStyle nameStyle(double height, std::size_t rows) {
  TextStyle style;
  style.horizontal = Align::high;
  style.size = std::clamp(std::floor(0.7 * height / static_cast<double>(rows)), 7.0, 14.0);
  return style;
}

double rowPosition(std::size_t row, std::size_t rows) {
  return static_cast<double>(rows) - static_cast<double>(row) - 0.5;
}

/// Legend entries: a marker or line and its name, one after the other.
class Key {
 public:
  Key(Canvas& canvas, double left, double y) : canvas_(canvas), x_(left), y_(y) {}
  void marker(Marker shape, const Color& color, const std::string& name) {
    canvas_.marker(shape, {x_ + 8.0, y_}, 11.0, color);
    text(name, 22.0);
  }
  void line(const std::string& name) {
    canvas_.line({x_, y_}, {x_ + 24.0, y_}, 2.0, ink::gray);
    text(name, 32.0);
  }

 private:
  void text(const std::string& name, double shift) {
    const double available = canvas_.width() - kPlotMargin - x_ - shift;
    x_ = canvas_.text(detail::shortened(name, std::max(0.0, available), {}), {x_ + shift, y_})
             .right() +
         30.0;
  }
  Canvas& canvas_;
  double x_, y_;
};

void drawLimits(Canvas& canvas, const Axes& axes, const BeforeAfterPlot& plot) {
  TextStyle style;
  style.size = 12.0;
  style.color = ink::gray;
  style.upward = true;
  style.vertical = Align::low;
  const PixelBox& box = axes.box();
  double last = -1e9;
  for (const BeforeAfterPlot::Limit& limit : plot.limits) {
    const double x = axes.pixel(limit.value, 0.0).x();
    if (!(x > box.x && x < box.right())) continue;
    const int dashes = static_cast<int>(std::ceil(box.height / 12.0));
    for (int i = 0; i < dashes; ++i) {
      const double y = box.y + 12.0 * i;
      canvas.line({x, y}, {x, std::min(y + 7.0, box.bottom())}, 1.5, ink::gray);
    }
    // Names that would cover each other or leave the box are excluded.
    if (x - last < 18.0 || Canvas::textSize(limit.name, style).x() > box.height - 12.0) continue;
    if (x + 20.0 > box.right()) continue;
    canvas.text(limit.name, {x + 4.0, box.y + 6.0}, style);
    last = x;
  }
}

}  // namespace

void BeforeAfterPlot::keepLargest(std::size_t most) {
  detail::keepLargest(rows, most, shownValue);
}

int heightForRows(std::size_t rows) {
  return 220 + 26 * static_cast<int>(std::min<std::size_t>(rows, 60));
}

Canvas drawBeforeAfter(const BeforeAfterPlot& plot, PictureSize size) {
  if (plot.rows.empty()) throw UsageError("plot '" + plot.title + "': contains no row");
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, plot.title);
  std::vector<double> values = {0.0};
  double widest = 0.0;
  bool any_before = false;
  for (const BeforeAfterPlot::Row& row : plot.rows) {
    values.insert(values.end(), {row.before, row.after});
    any_before = any_before || std::isfinite(row.before);
    widest = std::max(widest, Canvas::textSize(row.name, {}).x());
  }
  const double left = std::min(widest, 0.3 * size.width) + kPlotMargin + 14.0;
  const PixelBox box{left, top + 40.0, size.width - left - 2.0 * kPlotMargin,
                     size.height - top - 40.0 - kAxisHeight};
  Axes axes(canvas, box, Axis::around(values, plot.x_label, true), rowAxis(plot.rows.size()));
  drawLimits(canvas, axes, plot);
  const TextStyle name = nameStyle(box.height, plot.rows.size());
  const double dot =
      std::clamp(0.5 * box.height / static_cast<double>(plot.rows.size()), 4.0, 12.0);
  for (std::size_t i = 0; i < plot.rows.size(); ++i) {
    const BeforeAfterPlot::Row& row = plot.rows[i];
    const double at = rowPosition(i, plot.rows.size());
    const Eigen::Vector2d before = axes.pixel(row.before, at), after = axes.pixel(row.after, at);
    if (before.allFinite() && after.allFinite())
      canvas.line(before, after, 2.0, ink::gray.withAlpha(120));
    canvas.marker(Marker::diamond, before, dot, ink::before);
    canvas.marker(Marker::disk, after, dot, ink::after);
    canvas.text(detail::shortened(row.name, left - kPlotMargin, name),
                {box.x - 10.0, axes.pixel(0.0, at).y()}, name);
  }
  axes.drawFrame();
  Key key(canvas, box.x, top + 20.0);
  if (any_before) key.marker(Marker::diamond, ink::before, plot.before);
  key.marker(Marker::disk, ink::after, plot.after);
  if (!plot.limits.empty()) key.line("limits");
  return canvas;
}

Canvas drawIntervals(const IntervalPlot& plot, PictureSize size) {
  if (plot.rows.empty()) throw UsageError("plot '" + plot.title + "': contains no row");
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, plot.title);
  std::vector<double> reach;
  double names = 0.0, texts = 0.0;
  if (std::isfinite(plot.reference)) reach.push_back(plot.reference);
  for (const IntervalPlot::Row& row : plot.rows) {
    const double half = std::isfinite(row.std) ? kNormal95 * row.std : 0.0;
    reach.insert(reach.end(), {row.value - half, row.value + half});
    names = std::max(names, Canvas::textSize(row.name, {}).x());
    texts = std::max(texts, Canvas::textSize(row.text, {}).x());
  }
  const double left = std::min(names, 0.25 * size.width) + kPlotMargin + 14.0;
  const double right = std::min(texts, 0.35 * size.width) + kPlotMargin + 16.0;
  const PixelBox box{left, top + 12.0, size.width - left - right,
                     size.height - top - 12.0 - kAxisHeight};
  Axes axes(canvas, box, Axis::around(reach, plot.x_label), rowAxis(plot.rows.size()));
  if (std::isfinite(plot.reference)) axes.verticalLine(plot.reference, 1.5, ink::gray);
  TextStyle name = nameStyle(box.height, plot.rows.size()), value = name;
  value.horizontal = Align::low;
  for (std::size_t i = 0; i < plot.rows.size(); ++i) {
    const IntervalPlot::Row& row = plot.rows[i];
    const double at = rowPosition(i, plot.rows.size());
    const bool known = std::isfinite(row.std);
    const Color color = known ? ink::after : ink::gray;
    const double half = known ? kNormal95 * row.std : 0.0;
    const Eigen::Vector2d low = axes.pixel(row.value - half, at),
                          high = axes.pixel(row.value + half, at);
    canvas.line(low, high, 3.0, color);
    canvas.marker(known ? Marker::disk : Marker::ring, axes.pixel(row.value, at), 9.0, color);
    name.color = value.color = known ? ink::black : ink::gray;
    canvas.text(detail::shortened(row.name, left - kPlotMargin, name), {box.x - 10.0, low.y()},
                name);
    canvas.text(detail::shortened(row.text, right - kPlotMargin, value),
                {box.right() + 12.0, low.y()}, value);
  }
  axes.drawFrame();
  return canvas;
}

}  // namespace pcl_als
