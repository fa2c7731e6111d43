// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/drawing/canvas.h>
#include <pcl_als/drawing/ticks.h>

namespace pcl_als {

/// One axis of a panel.
struct Axis {
  double low = 0.0, high = 1.0;
  std::string label;         ///< with unit, e.g. "height, m"
  bool logarithmic = false;  ///< low and high > 0
  bool ticks = true;

  /// Covers the values with a margin; zero included on request. A single value has a margin on both
  /// sides; without values the axis is [0, 1].
  static Axis around(const std::vector<double>& values, std::string label, bool with_zero = false);
  /// 0 at low, 1 at high.
  double share(double value) const;
};

/** \brief The coordinate system of a plot in a box of a Canvas.
 *
 * Drawing order: the constructor draws ground and grid, then data, then drawFrame() puts ticks,
 * labels and frame above them. Data outside the box is cut off.
 */
class Axes {
 public:
  Axes(Canvas& canvas, const PixelBox& box, const Axis& x, const Axis& y);

  const PixelBox& box() const { return box_; }
  Eigen::Vector2d pixel(double x, double y) const;

  void line(const std::vector<double>& x, const std::vector<double>& y, double width,
            const Color& color);
  void points(const std::vector<double>& x, const std::vector<double>& y, double diameter,
              const Color& color, Marker shape = Marker::disk);
  /// Intervals y - half … y + half as strokes with caps.
  void errorBars(const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& half, const Color& color);
  void horizontalLine(double y, double width, const Color& color);
  void verticalLine(double x, double width, const Color& color);
  void drawFrame(const std::string& title = {});

 private:
  void drawGrid();
  struct Mark {
    double share;
    std::string label;
  };
  static std::vector<Mark> marksOf(const Axis& axis, int most);

  Canvas& canvas_;
  PixelBox box_;
  Axis x_, y_;
  std::vector<Mark> x_marks_, y_marks_;
};

}  // namespace pcl_als
