// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/registration/point_view.h>

namespace pcl_als::registration {

/// Points of a view in the working coordinates of an alignment: near zero, the source after the
/// initial motion.
class WorkingPoints {
 public:
  WorkingPoints(const PointView& view, const Eigen::Affine3d& working_from_ground)
      : view_(view), to_working_(working_from_ground) {}
  std::size_t count() const { return view_.count; }
  /// Not finite where the point is not.
  Eigen::Vector3d operator[](std::size_t i) const { return to_working_ * view_.position(i); }

 private:
  PointView view_;
  Eigen::Affine3d to_working_;
};

/// Square cells over a box in plan.
struct PlanGrid {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();
  double cell = 1.0;  ///< metres
  int columns = 0, rows = 0;

  PlanGrid() = default;
  PlanGrid(const Eigen::AlignedBox2d& box, double cell_size);
  std::size_t size() const { return static_cast<std::size_t>(columns) * rows; }
  /// Index of the cell of a position; -1 outside.
  std::int64_t cellOf(double x, double y) const {
    const double column = (x - corner.x()) / cell, row = (y - corner.y()) / cell;
    if (!(column >= 0.0 && row >= 0.0 && column < columns && row < rows)) return -1;
    return static_cast<std::int64_t>(row) * columns + static_cast<std::int64_t>(column);
  }
  Eigen::Vector2d centreOf(std::size_t index) const {
    const auto column = static_cast<double>(index % columns);
    const auto row = static_cast<double>(index / columns);
    return corner + cell * Eigen::Vector2d(column + 0.5, row + 0.5);
  }
};

/// Number of points of each cell, and its lowest point, which is mostly ground or roof.
class LowestPoints {
 public:
  LowestPoints() = default;
  LowestPoints(const WorkingPoints& points, const PlanGrid& grid);
  /// Combines two by two cells.
  LowestPoints pooled() const;

  const PlanGrid& grid() const { return grid_; }
  std::uint32_t countAt(std::size_t cell) const { return counts_[cell]; }
  Eigen::Vector3d at(std::size_t cell) const { return lowest_[cell].cast<double>(); }
  std::vector<Eigen::Vector3d> points() const;

 private:
  PlanGrid grid_;
  std::vector<std::uint32_t> counts_;
  std::vector<Eigen::Vector3f> lowest_;
};

}  // namespace pcl_als::registration
