// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/drawing/canvas.h>

namespace pcl_als {

/// One line of a legend.
struct LegendEntry {
  std::string name;
  Color color;
  bool line = false;  ///< a stroke instead of a square
};

/// Width and height of a legend, a column with an optional heading.
Eigen::Vector2d legendSize(const std::vector<LegendEntry>& entries, const std::string& heading,
                           double text_size = 14.0);
void drawLegend(Canvas& canvas, const std::vector<LegendEntry>& entries, const std::string& heading,
                const Eigen::Vector2d& corner, double text_size = 14.0);

/// A scale of colours with ticks on its right; \a box is the coloured part. The heading, e.g.
/// "height, m", stands above.
void drawColorBar(Canvas& canvas, const ColorMap& map, double low, double high,
                  const std::string& heading, const PixelBox& box);

/// A bar of a round number of metres, at most \a most_pixels long, with its length above; its left
/// end is at \a corner (lower left of text and bar together). Returns the bar itself.
PixelBox drawScaleBar(Canvas& canvas, double metres_per_pixel, double most_pixels,
                      const Eigen::Vector2d& corner);

/// An arrow to grid north; \a direction is that of north in the picture (x right, y down).
void drawNorthArrow(Canvas& canvas, const Eigen::Vector2d& center, double length,
                    const Eigen::Vector2d& direction = {0.0, -1.0});

/// Ticks with ground coordinates below and on the left of a map whose upper left corner is known.
/// Needs some 90 pixels on the left and 30 below.
void drawCoordinates(Canvas& canvas, const Eigen::Vector2d& north_west, double metres_per_pixel,
                     const PixelBox& box);

}  // namespace pcl_als
