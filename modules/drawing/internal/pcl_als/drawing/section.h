// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/drawing/result_plots.h>

namespace pcl_als {

/// A vertical section: from one point to another in plan, and how far points may lie from it.
struct SectionLine {
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();  ///< metres
  double half_width = 1.0;                                                       ///< metres

  double length() const { return (to - from).norm(); }
  /// Whether a place is in the section, or at most a distance in metres beside it.
  bool contains(const Eigen::Vector2d& place, double margin = 0.0) const;
};

/** \brief Collects the points of a section by strip.
 *
 * More than \a most points are thinned evenly: every second, then every fourth of them in the order
 * of input, and so on.
 */
class SectionPoints {
 public:
  struct Point {
    float along, height;  ///< metres from the line's start; metres above the first height
    int strip;
  };

  /// UsageError unless the line has a length and a width.
  explicit SectionPoints(const SectionLine& line, std::size_t most = 2000000);

  void add(const Eigen::Vector3d& ground, int strip);

  const SectionLine& line() const { return line_; }
  double baseHeight() const { return base_; }  ///< what heights are relative to, metres
  const std::vector<Point>& points() const { return points_; }
  std::size_t seen() const { return seen_; }

 private:
  SectionLine line_;
  Eigen::Vector2d along_;
  std::size_t most_, seen_ = 0, stride_ = 1;
  double base_ = 0.0;
  std::vector<Point> points_;
};

/** \brief Draws sections of the same line above each other on the same axes, as for before and
 * after: distance and height in metres, points coloured by strip, the vertical exaggeration stated.
 *
 * The height axis shows all points, unless nine tenths of them lie within a third of the whole
 * range: then it shows these and a quarter of their range on both sides, and points beyond are
 * marked by triangles at the edge and counted.
 */
class SectionPicture {
 public:
  void setTitle(std::string title) { title_ = std::move(title); }
  void setStrips(std::vector<std::string> names) { strips_ = std::move(names); }
  /// \a points has to live until draw(). UsageError where the line is not that of the others.
  void addPanel(std::string caption, const SectionPoints& points);

  /// UsageError without a panel or without any point.
  Canvas draw(PictureSize size = {}) const;
  /// Exaggeration of heights against lengths, a round number.
  double exaggeration(PictureSize size = {}) const;

 private:
  struct Panel {
    std::string caption;
    const SectionPoints* points;
  };
  struct Layout {
    double left, width, height, top, pitch;  ///< of the panels' boxes, pixels
    double exaggeration, low, high;          ///< of the height axis, metres
    std::size_t above, below;                ///< points beyond it, all panels
    std::vector<int> shown;                  ///< strips with points
  };
  Layout layoutFor(PictureSize size) const;
  /// The heights that the axis has to show, metres.
  std::pair<double, double> heightRange() const;
  void drawPanel(Canvas& canvas, const Layout& layout, std::size_t panel) const;

  std::string title_;
  std::vector<std::string> strips_;
  std::vector<Panel> panels_;
};

}  // namespace pcl_als
