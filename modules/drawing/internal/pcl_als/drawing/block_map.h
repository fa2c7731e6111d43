// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/drawing/result_plots.h>

namespace pcl_als {

/** \brief Cells of a grid with points of each strip; filled point by point, by different threads
 * for different strips.
 *
 * One byte per cell and strip; cells are so large that all take at most some 16 MB.
 */
class StripCoverage {
 public:
  StripCoverage(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, std::size_t strips);

  void add(const Eigen::Vector3d& ground, std::size_t strip);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double cell() const { return cell_; }
  const Eigen::Vector2d& minimum() const { return minimum_; }
  std::size_t strips() const { return cells_.size(); }
  /// Whether the strip has a point in the cell; false outside the grid.
  bool covers(std::size_t strip, int column, int row) const;

 private:
  Eigen::Vector2d minimum_;
  double cell_;
  int columns_, rows_;
  std::vector<std::vector<char>> cells_;
};

/** \brief A map of a block: number of strips at each place, outlines of the strips with their
 * names, chosen areas, control points, flight paths and marked parts of them.
 */
class BlockMap {
 public:
  /// A square or rectangle of the ground.
  struct Area {
    Eigen::Vector2d minimum, maximum;
  };
  /// A flight path with its standard deviations east and north, metres; as many as places.
  struct Path {
    std::vector<Eigen::Vector2d> places, std;
  };
  /// A straight part of a flight path that is named by a short label, such as a number.
  struct Mark {
    Eigen::Vector2d begin, end;  ///< metres, ground frame
    std::string label;
  };
  void setTitle(std::string title) { title_ = std::move(title); }
  void setAreas(std::vector<Area> areas) { areas_ = std::move(areas); }
  void setControl(std::vector<Eigen::Vector2d> points) { control_ = std::move(points); }

  /// Parts that are marked, with what the legend calls them. Labels of marks at the same place are
  /// joined.
  void setMarks(std::vector<Mark> marks, std::string legend) {
    marks_ = std::move(marks);
    marks_legend_ = std::move(legend);
  }

  /// Standard deviations are drawn as bars, enlarged by a factor, at some places of each path.
  void setPaths(std::vector<Path> paths, double enlargement) {
    paths_ = std::move(paths);
    enlargement_ = enlargement;
  }

  /// The height of the picture for a width, within limits.
  static int heightFor(const StripCoverage& coverage, int width, int lowest = 560,
                       int highest = 1400);
  /// \param names one for each strip of the coverage, else UsageError
  Canvas draw(const StripCoverage& coverage, const std::vector<std::string>& names,
              PictureSize size = {}) const;

 private:
  std::string title_;
  std::vector<Area> areas_;
  std::vector<Eigen::Vector2d> control_;
  std::vector<Path> paths_;
  std::vector<Mark> marks_;
  std::string marks_legend_;
  double enlargement_ = 1.0;
};

}  // namespace pcl_als
