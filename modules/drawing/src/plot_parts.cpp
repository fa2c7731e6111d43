// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "plot_parts.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/drawing/map_furniture.h>

namespace pcl_als::detail {
namespace {

constexpr double kNameSize = 14.0;

double widest(const std::vector<std::string>& texts, const TextStyle& style) {
  double width = 0.0;
  for (const std::string& text : texts) width = std::max(width, Canvas::textSize(text, style).x());
  return width;
}

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool isDark(const Color& color) {
  return 0.299 * color.r + 0.587 * color.g + 0.114 * color.b < 140.0;
}

}  // namespace

double drawTitle(Canvas& canvas, const std::string& title) {
  if (title.empty()) return kPlotMargin;
  TextStyle style;
  style.size = 20.0;
  style.bold = true;
  canvas.text(shortened(title, canvas.width() - 2.0 * kPlotMargin, style),
              {kPlotMargin, kPlotMargin + 12.0}, style);
  return kPlotMargin + 40.0;
}

PanelGrid::PanelGrid(std::size_t panels, double width, double height) {
  double best = 0.0;
  for (int c = 1; c <= static_cast<int>(panels); ++c) {
    const int r = (static_cast<int>(panels) + c - 1) / c;
    const double usable = std::min(width / c, 1.9 * height / r);
    if (usable <= best) continue;
    best = usable;
    columns = c;
    rows = r;
  }
  pitch_x = width / columns;
  pitch_y = height / rows;
}

Eigen::Vector2d PanelGrid::corner(std::size_t panel) const {
  const int i = static_cast<int>(panel);
  return {i % columns * pitch_x, i / columns * pitch_y};
}

std::vector<Color> seriesColors(const std::vector<std::string>& names) {
  std::vector<Color> colors;
  std::size_t before = 0, after = 0, other = 0;
  for (const std::string& name : names) {
    if (endsWith(name, "before") && before == 0) {
      colors.push_back(ink::before);
      ++before;
    } else if (endsWith(name, "after") && after == 0) {
      colors.push_back(ink::after);
      ++after;
    } else {
      colors.push_back(categoryColor(other + (before + after > 0 ? 2 : 0)));
      ++other;
    }
  }
  return colors;
}

Marker markerOf(const std::string& series) {
  return endsWith(series, "before") ? Marker::diamond : Marker::disk;
}

std::vector<LegendEntry> fitting(std::vector<LegendEntry> entries, double height) {
  std::size_t most = entries.size();
  while (most > 2 &&
         legendSize({entries.begin(), entries.begin() + static_cast<long>(most)}, "x").y() > height)
    --most;
  if (most == entries.size()) return entries;
  const std::size_t more = entries.size() - most + 1;
  entries.resize(most - 1);
  entries.push_back({"and " + std::to_string(more) + " more", ink::white});
  return entries;
}

std::string shortened(const std::string& text, double width, const TextStyle& style) {
  // No character is narrower than a fifth of its height: longer texts need not be measured.
  const auto most = static_cast<std::size_t>(std::max(0.0, 4.0 * 5.0 * width / style.size)) + 16;
  if (text.size() <= most && Canvas::textSize(text, style).x() <= width) return text;
  // Lengths in bytes at which a character of UTF-8 begins: none of those after it that begin
  // with 10.
  std::vector<std::size_t> ends = {0};
  for (std::size_t i = 1; i < std::min(text.size(), most); ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) ends.push_back(i);
  }
  const auto too_wide = std::partition_point(ends.begin(), ends.end(), [&](std::size_t end) {
    return Canvas::textSize(text.substr(0, end) + "…", style).x() <= width;
  });
  if (too_wide == ends.begin()) return {};
  const std::size_t end = *(too_wide - 1);
  return end == 0 ? std::string() : text.substr(0, end) + "…";
}

std::vector<std::string> wrapped(const std::string& text, double width, const TextStyle& style,
                                 std::size_t most) {
  std::vector<std::string> lines;
  std::string rest = text;
  while (!rest.empty() && lines.size() + 1 < most && Canvas::textSize(rest, style).x() > width) {
    std::size_t end = rest.size();
    do {
      end = rest.rfind(' ', end - 1);
    } while (end != std::string::npos && end > 0 &&
             Canvas::textSize(rest.substr(0, end), style).x() > width);
    if (end == std::string::npos || end == 0) break;
    lines.push_back(rest.substr(0, end));
    rest = rest.substr(end + 1);
  }
  lines.push_back(shortened(rest, width, style));
  return lines;
}

PixelBox drawHeatMap(Canvas& canvas, const HeatMap& heat, const ColorMap& map,
                     const PixelBox& box) {
  TextStyle style;
  style.size = kNameSize;
  const double heading = heat.row_heading.empty() ? 0.0 : 28.0;
  const double left = std::min(widest(heat.rows, style), 0.4 * box.width) + 14.0 + heading;
  const double count = static_cast<double>(heat.columns.size());
  const bool upright =
      widest(heat.columns, style) > std::min((box.width - left) / count, 190.0) - 6.0;
  const double top =
      (upright ? std::min(widest(heat.columns, style), 0.4 * box.height) : kNameSize) + 18.0 +
      heading;
  const double cell =
      std::floor(std::min({(box.width - left) / count,
                           (box.height - top) / static_cast<double>(heat.rows.size()), 190.0}));
  const PixelBox cells{std::round(box.x + left), std::round(box.y + top), cell * count,
                       cell * static_cast<double>(heat.rows.size())};
  TextStyle number;
  number.size = std::clamp(std::floor(0.24 * cell), 9.0, 20.0);
  number.horizontal = number.vertical = Align::center;
  for (std::size_t r = 0; r < heat.rows.size(); ++r) {
    for (std::size_t c = 0; c < heat.columns.size(); ++c) {
      const PixelBox at{cells.x + cell * static_cast<double>(c),
                        cells.y + cell * static_cast<double>(r), cell, cell};
      const Color color = std::isnan(heat.shade[r][c]) ? ink::white : map(heat.shade[r][c]);
      canvas.fill(at, color);
      canvas.frame(at, 0.5, ink::white);
      number.color = isDark(color) ? ink::on_dark : ink::on_light;
      canvas.text(heat.texts[r][c], {at.x + 0.5 * cell, at.y + 0.5 * cell}, number);
    }
  }
  canvas.frame(cells, 1.0, ink::gray);
  style.horizontal = Align::high;
  for (std::size_t r = 0; r < heat.rows.size(); ++r) {
    canvas.text(shortened(heat.rows[r], left - 12.0 - heading, style),
                {cells.x - 8.0, cells.y + cell * (static_cast<double>(r) + 0.5)}, style);
  }
  style.horizontal = Align::center;
  style.vertical = Align::high;
  style.upward = upright;
  for (std::size_t c = 0; c < heat.columns.size(); ++c) {
    canvas.text(shortened(heat.columns[c], upright ? top - 18.0 - heading : cell - 4.0, style),
                {cells.x + cell * (static_cast<double>(c) + 0.5), cells.y - 6.0}, style);
  }
  TextStyle bold;
  bold.bold = true;
  bold.horizontal = Align::center;
  canvas.text(heat.column_heading, {cells.x + 0.5 * cells.width, box.y + 10.0}, bold);
  bold.upward = true;
  canvas.text(heat.row_heading, {box.x + 10.0, cells.y + 0.5 * cells.height}, bold);
  return cells;
}

}  // namespace pcl_als::detail
