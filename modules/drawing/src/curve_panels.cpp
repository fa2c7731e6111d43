// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/axes.h>
#include <pcl_als/drawing/curve_panels.h>
#include <pcl_als/drawing/map_furniture.h>

#include "plot_parts.h"

namespace pcl_als {
namespace {

using detail::kPlotMargin;

constexpr std::size_t kMostMarked = 40;  // points of a line; more are drawn as a line alone

double largestValue(const CurvePanels::Panel& panel) {
  double largest = 0.0;
  for (const CurvePlot::Series& series : panel.series) {
    for (const double value : series.y)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

void appendRange(const CurvePanels::Panel& panel, std::vector<double>& x, std::vector<double>& y) {
  for (const CurvePlot::Series& series : panel.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!std::isfinite(series.x[i]) || !std::isfinite(series.y[i])) continue;
      const double half = series.std.empty() || !std::isfinite(series.std[i]) ? 0.0 : series.std[i];
      x.push_back(series.x[i]);
      y.insert(y.end(), {series.y[i] - half, series.y[i] + half});
    }
  }
}

/// Names of the series, in order of appearance.
std::vector<std::string> seriesNames(const CurvePanels& plot) {
  std::vector<std::string> names;
  for (const CurvePanels::Panel& panel : plot.panels) {
    for (const CurvePlot::Series& series : panel.series) {
      if (std::find(names.begin(), names.end(), series.name) == names.end())
        names.push_back(series.name);
    }
  }
  return names;
}

/// Legend in one line on the right above the panels; a single series needs none.
void drawKey(Canvas& canvas, const std::vector<std::string>& names,
             const std::vector<Color>& colors, double y) {
  if (names.size() < 2) return;
  TextStyle style;
  double x = kPlotMargin;
  for (std::size_t i = 0; i < names.size(); ++i) {
    canvas.line({x, y}, {x + 24.0, y}, 2.5, colors[i]);
    canvas.marker(detail::markerOf(names[i]), {x + 12.0, y}, 8.0, colors[i]);
    x = canvas.text(detail::shortened(names[i], 200.0, style), {x + 32.0, y}, style).right() + 28.0;
  }
}

void drawPanel(Canvas& canvas, const CurvePanels::Panel& panel,
               const std::vector<std::string>& names, const std::vector<Color>& colors,
               const PixelBox& box, const Axis& x, const Axis& y) {
  Axes axes(canvas, box, x, y);
  if (y.low < 0.0 && y.high > 0.0) axes.horizontalLine(0.0, 1.5, ink::gray);
  for (const CurvePlot::Series& series : panel.series) {
    const auto at = std::find(names.begin(), names.end(), series.name) - names.begin();
    const Color color = colors[static_cast<std::size_t>(at)];
    axes.errorBars(series.x, series.y, series.std, color.withAlpha(110));
    axes.line(series.x, series.y, 2.0, color);
    if (series.x.size() <= kMostMarked)
      axes.points(series.x, series.y, 5.5, color, detail::markerOf(series.name));
  }
  TextStyle bold;
  bold.size = 15.0;
  bold.bold = true;
  axes.drawFrame(detail::shortened(panel.title, box.width, bold));
}

void check(const CurvePanels& plot) {
  bool any = false;
  for (const CurvePanels::Panel& panel : plot.panels) {
    for (const CurvePlot::Series& series : panel.series) {
      if (series.x.size() != series.y.size() ||
          (!series.std.empty() && series.std.size() != series.x.size()))
        throw UsageError("plot '" + plot.title + "': series '" + series.name +
                         "' has not as many x as y and std");
    }
    std::vector<double> x, y;
    appendRange(panel, x, y);
    any = any || !x.empty();
  }
  if (!any) throw UsageError("plot '" + plot.title + "': contains no finite values");
}

}  // namespace

void CurvePanels::keepLargest(std::size_t most) {
  detail::keepLargest(panels, most, largestValue);
}

Canvas drawCurvePanels(const CurvePanels& plot, PictureSize size) {
  check(plot);
  Canvas canvas(size.width, size.height);
  double top = detail::drawTitle(canvas, plot.title);
  const std::vector<std::string> names = seriesNames(plot);
  const std::vector<Color> colors = detail::seriesColors(names);
  drawKey(canvas, names, colors, top + 4.0);
  top += names.size() < 2 ? 16.0 : 40.0;
  constexpr double kLeft = 92.0, kHead = 24.0, kFoot = 32.0, kLabel = 26.0;
  const detail::PanelGrid grid(plot.panels.size(), size.width - kPlotMargin,
                               size.height - top - kLabel);
  if (grid.pitch_x < kLeft + 60.0 || grid.pitch_y < kHead + kFoot + 40.0)
    throw UsageError("plot '" + plot.title + "': the picture is too small for its panels");
  std::vector<double> all_x, all_y;
  for (const CurvePanels::Panel& panel : plot.panels) appendRange(panel, all_x, all_y);
  const Axis common = Axis::around(all_x, "");
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const Eigen::Vector2d corner = grid.corner(i);
    std::vector<double> x, y;
    appendRange(plot.panels[i], x, y);
    drawPanel(canvas, plot.panels[i], names, colors,
              {kLeft + corner.x(), top + corner.y() + kHead, grid.pitch_x - kLeft,
               grid.pitch_y - kHead - kFoot},
              plot.common_x ? common : Axis::around(x, ""),
              Axis::around(all_y, corner.x() == 0.0 ? plot.y_label : ""));
  }
  TextStyle label;
  label.horizontal = Align::center;
  canvas.text(plot.x_label, {0.5 * (kLeft + size.width), size.height - 0.6 * kLabel}, label);
  return canvas;
}

}  // namespace pcl_als
