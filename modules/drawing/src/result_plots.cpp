// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/drawing/axes.h>
#include <pcl_als/drawing/map_furniture.h>
#include <pcl_als/drawing/result_plots.h>

#include "plot_parts.h"

namespace pcl_als {
namespace {

using detail::kPlotMargin;

PixelBox plotBox(const Canvas& canvas, double top, double legend_width) {
  const double left = 110.0, bottom = 84.0;
  const double right = legend_width > 0.0 ? legend_width + 2.0 * kPlotMargin : kPlotMargin;
  return {left, top + 12.0, canvas.width() - left - right, canvas.height() - top - 12.0 - bottom};
}

std::vector<LegendEntry> legendOf(const std::vector<std::string>& names,
                                  const std::vector<Color>& colors, double most_width) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < names.size(); ++i) {
    entries.push_back({detail::shortened(names[i], most_width, {}), colors[i], true});
  }
  return entries;
}

void refuse(const std::string& title, const std::string& what) {
  throw UsageError("plot '" + title + "': " + what);
}

void checkCurves(const CurvePlot& plot) {
  bool any = false;
  for (const CurvePlot::Series& series : plot.series) {
    if (series.x.size() != series.y.size() ||
        (!series.std.empty() && series.std.size() != series.x.size())) {
      refuse(plot.title, "series '" + series.name + "' has not as many x as y and std");
    }
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      any = any || (std::isfinite(series.x[i]) && std::isfinite(series.y[i]));
    }
  }
  if (!any) refuse(plot.title, "contains no finite values");
}

/// Step outline of a histogram in percent.
void outline(const std::vector<double>& edges, const std::vector<double>& percent,
             std::vector<double>& x, std::vector<double>& y) {
  x = {edges.front()};
  y = {0.0};
  for (std::size_t i = 0; i < percent.size(); ++i) {
    x.insert(x.end(), {edges[i], edges[i + 1]});
    y.insert(y.end(), {percent[i], percent[i]});
  }
  x.push_back(edges.back());
  y.push_back(0.0);
}

}  // namespace

Canvas drawCurves(const CurvePlot& plot, PictureSize size) {
  checkCurves(plot);
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, plot.title);
  std::vector<double> all_x, all_y;
  std::vector<std::string> names;
  for (const CurvePlot::Series& series : plot.series) {
    names.push_back(series.name);
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      all_x.push_back(series.x[i]);
      const double half = series.std.empty() || !std::isfinite(series.std[i]) ? 0.0 : series.std[i];
      all_y.insert(all_y.end(), {series.y[i] - half, series.y[i] + half});
    }
  }
  const std::vector<Color> colors = detail::seriesColors(names);
  const auto entries = detail::fitting(legendOf(names, colors, 0.25 * size.width),
                                       size.height - top - 2.0 * kPlotMargin);
  const double legend = names.size() > 1 ? legendSize(entries, "").x() : 0.0;
  const PixelBox box = plotBox(canvas, top, legend);
  const Axis y = Axis::around(all_y, plot.y_label);
  Axes axes(canvas, box, Axis::around(all_x, plot.x_label), y);
  if (y.low < 0.0 && y.high > 0.0) axes.horizontalLine(0.0, 1.5, ink::gray);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const CurvePlot::Series& series = plot.series[i];
    axes.errorBars(series.x, series.y, series.std, colors[i].withAlpha(150));
    axes.line(series.x, series.y, 2.0, colors[i]);
    axes.points(series.x, series.y, 7.0, colors[i], detail::markerOf(series.name));
  }
  axes.drawFrame();
  if (legend > 0.0) drawLegend(canvas, entries, "", {box.right() + kPlotMargin, box.y});
  return canvas;
}

Canvas drawHistogram(const HistogramPlot& plot, PictureSize size) {
  if (plot.series.empty()) refuse(plot.title, "contains no series");
  std::vector<std::vector<double>> percents;
  std::vector<double> all = {0.0};
  std::vector<std::string> names;
  for (const HistogramPlot::Series& series : plot.series) {
    if (series.counts.empty() || plot.edges.size() != series.counts.size() + 1) {
      refuse(plot.title, "series '" + series.name + "' has not one count for each bin");
    }
    double sum = 0.0;
    for (const double count : series.counts) sum += count;
    std::vector<double> percent = series.counts;
    for (double& value : percent) value *= sum > 0.0 ? 100.0 / sum : 0.0;
    all.insert(all.end(), percent.begin(), percent.end());
    percents.push_back(std::move(percent));
    names.push_back(series.name);
  }
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, plot.title);
  const std::vector<Color> colors = detail::seriesColors(names);
  const auto entries = detail::fitting(legendOf(names, colors, 0.25 * size.width),
                                       size.height - top - 2.0 * kPlotMargin);
  const PixelBox box = plotBox(canvas, top, legendSize(entries, "").x());
  Axis x;
  x.low = plot.edges.front();
  x.high = plot.edges.back();
  x.label = plot.x_label;
  Axes axes(canvas, box, x, Axis::around(all, "share of all in a bin, %", true));
  for (std::size_t i = 0; i < percents.size(); ++i) {
    for (std::size_t bin = 0; bin < percents[i].size(); ++bin) {
      const Eigen::Vector2d low = axes.pixel(plot.edges[bin], 0.0);
      const Eigen::Vector2d high = axes.pixel(plot.edges[bin + 1], percents[i][bin]);
      canvas.fill({low.x(), high.y(), high.x() - low.x(), low.y() - high.y()},
                  colors[i].withAlpha(60));
    }
    std::vector<double> at, height;
    outline(plot.edges, percents[i], at, height);
    axes.line(at, height, 2.0, colors[i]);
  }
  axes.drawFrame();
  drawLegend(canvas, entries, "", {box.right() + kPlotMargin, box.y});
  return canvas;
}

Canvas drawConfusion(const ConfusionPlot& plot, PictureSize size) {
  detail::HeatMap heat;
  heat.rows = heat.columns = plot.classes;
  heat.row_heading = "classified as";
  heat.column_heading = "reference";
  if (plot.classes.empty() || plot.matrix.size() != plot.classes.size()) {
    refuse(plot.title, "the matrix has not one row for each class");
  }
  for (const auto& row : plot.matrix) {
    if (row.size() != plot.classes.size()) {
      refuse(plot.title, "the matrix has not one column for each class");
    }
    double sum = 0.0;
    for (const double count : row) sum += count;
    auto& shade = heat.shade.emplace_back();
    auto& text = heat.texts.emplace_back();
    for (const double count : row) {
      shade.push_back(sum > 0.0 ? count / sum : 0.0);
      text.push_back(numberText(count, count == std::floor(count) ? 0 : 2));
    }
  }
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, plot.title);
  const ColorMap map = ColorMap::named("cividis");
  const PixelBox cells = detail::drawHeatMap(
      canvas, heat, map, {kPlotMargin, top, size.width - 260.0, size.height - top - kPlotMargin});
  const double height = std::min(cells.height - 40.0, 400.0);
  drawColorBar(canvas, map, 0.0, 100.0, "share of the row, %",
               {cells.right() + 50.0, cells.y + 30.0, 24.0, std::max(height, 60.0)});
  return canvas;
}

PictureSize pictureSizeIn(const std::string& text) {
  const std::vector<double> size = numbersIn(text, 'x');
  // Drawing takes some 35 bytes a pixel: larger pictures would end in a lack of memory.
  constexpr double kMostPixels = 40e6;
  if (size.size() == 2 && size[0] >= 200 && size[1] >= 150 && size[0] <= 16384 &&
      size[1] <= 16384 && size[0] * size[1] <= kMostPixels && size[0] == std::floor(size[0]) &&
      size[1] == std::floor(size[1])) {
    return {static_cast<int>(size[0]), static_cast<int>(size[1])};
  }
  throw UsageError("'" + text +
                   "' is no WIDTHxHEIGHT from 200x150 to 16384x16384 with 40 million pixels at "
                   "most");
}

}  // namespace pcl_als
