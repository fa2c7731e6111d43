// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/distributions.h>
#include <pcl_als/drawing/canvas.h>
#include <pcl_als/drawing/map_furniture.h>

namespace pcl_als::detail {

constexpr double kPlotMargin = 24.0;
/// 95 % of normal errors are smaller, in standard deviations.
inline const double kNormal95 = normalCritical(0.025);

/// Title of a whole picture; returns the y below it.
double drawTitle(Canvas& canvas, const std::string& title);

/// The text, shortened with "…" where it is wider than the given number of pixels.
std::string shortened(const std::string& text, double width, const TextStyle& style);

/// The text in lines of at most so many pixels, broken at blanks; the last of \a most is shortened.
std::vector<std::string> wrapped(const std::string& text, double width, const TextStyle& style,
                                 std::size_t most);

/// Colours of series by name: those that end in before and after have theirs, the first of each.
std::vector<Color> seriesColors(const std::vector<std::string>& names);
/// before is a diamond, so that it is told from after without its colour.
Marker markerOf(const std::string& series);

/// As many entries as fit so many pixels below each other; the last then says how many more.
std::vector<LegendEntry> fitting(std::vector<LegendEntry> entries, double height);

/// Panels of the same size side by side and below each other, about half as high as wide.
struct PanelGrid {
  int columns = 1, rows = 1;
  double pitch_x, pitch_y;  ///< pixels

  PanelGrid(std::size_t panels, double width, double height);
  /// The upper left corner of a panel from that of the first one.
  Eigen::Vector2d corner(std::size_t panel) const;
};

/// Drops all but the \a most items of largest value; those that stay keep their order.
template <typename Item, typename Value>
void keepLargest(std::vector<Item>& items, std::size_t most, Value value) {
  if (items.size() <= most) return;
  std::vector<std::size_t> order(items.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return value(items[a]) > value(items[b]); });
  order.resize(most);
  std::sort(order.begin(), order.end());
  std::vector<Item> kept;
  kept.reserve(most);
  for (const std::size_t i : order) kept.push_back(std::move(items[i]));
  items = std::move(kept);
}

/// Names of what rows and columns of a matrix stand for, and the matrix as coloured cells with
/// numbers. Text is white on dark cells.
struct HeatMap {
  std::vector<std::string> rows, columns;
  std::vector<std::vector<double>> shade;       ///< 0 … 1 of the colour map; NaN: empty
  std::vector<std::vector<std::string>> texts;  ///< one for each cell
  std::string row_heading, column_heading;
};
/// Draws it into a box that includes its names; returns the box of the cells.
PixelBox drawHeatMap(Canvas& canvas, const HeatMap& heat, const ColorMap& map, const PixelBox& box);

}  // namespace pcl_als::detail
