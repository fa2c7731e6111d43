// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// A plane fitted to the points of a cell, z = height + slope_x (x - cx) + slope_y (y - cy).
struct CellPlane {
  Eigen::Vector2d center;  ///< (cx, cy), metres, ground frame
  double height = 0.0, slope_x = 0.0, slope_y = 0.0;
  double rms = 0.0;  ///< of the points about the plane, metres
  std::size_t points = 0;

  double heightAt(double x, double y) const {
    return height + slope_x * (x - center.x()) + slope_y * (y - center.y());
  }
  Eigen::Vector3d normal() const { return Eigen::Vector3d(-slope_x, -slope_y, 1.0).normalized(); }
};

/** \brief Planes through the points of square cells, filled point by point, for pictures of the
 * height difference of two strips and for the search of profiles.
 *
 * 44 bytes per cell, at most kMostCells; a cell size that needs more is enlarged. For pictures
 * only: reported offsets are computed by modules that match surfaces.
 */
class PlaneGrid {
 public:
  static constexpr std::size_t kMostCells = std::size_t{1} << 23U;

  PlaneGrid(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, double cell);

  double cell() const { return cell_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  void add(const Eigen::Vector3d& ground);

  /// Row and column of the cell that holds a place; may lie outside the grid.
  std::pair<int, int> cellOf(const Eigen::Vector2d& place) const;
  /// The plane of a cell that has at least six points, not all in a line; by index or position.
  std::optional<CellPlane> plane(int column, int row) const;
  std::optional<CellPlane> planeAt(double x, double y) const;

 private:
  struct Sums {  // relative to the cell's centre and first height
    float height = 0.0F;
    std::uint32_t n = 0;
    float x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, zz = 0;
  };
  long indexOf(double x, double y) const;
  Eigen::Vector2d centerOf(int column, int row) const;

  Eigen::Vector2d minimum_;
  double cell_;
  int columns_, rows_;
  std::vector<Sums> sums_;
};

}  // namespace pcl_als
