// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/plane_grid.h>

namespace pcl_als {

PlaneGrid::PlaneGrid(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, double cell)
    : minimum_(minimum), cell_(cell) {
  const Eigen::Vector2d size = (maximum - minimum).cwiseMax(1e-3);
  if (!(cell > 0.0) || !size.allFinite()) throw UsageError("a grid of planes needs a cell size");
  const auto most = static_cast<double>(kMostCells);
  cell_ = std::max(cell, std::sqrt(size.x() * size.y() / most));
  while ((std::floor(size.x() / cell_) + 1.0) * (std::floor(size.y() / cell_) + 1.0) > most) {
    cell_ *= 1.1;
  }
  columns_ = static_cast<int>(size.x() / cell_) + 1;
  rows_ = static_cast<int>(size.y() / cell_) + 1;
  sums_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

long PlaneGrid::indexOf(double x, double y) const {
  const double column = std::floor((x - minimum_.x()) / cell_);
  const double row = std::floor((y - minimum_.y()) / cell_);
  if (!(column >= 0.0 && row >= 0.0 && column < columns_ && row < rows_)) return -1;
  return static_cast<long>(row) * columns_ + static_cast<long>(column);
}

Eigen::Vector2d PlaneGrid::centerOf(int column, int row) const {
  return minimum_ + cell_ * Eigen::Vector2d(column + 0.5, row + 0.5);
}

void PlaneGrid::add(const Eigen::Vector3d& ground) {
  const long index = indexOf(ground.x(), ground.y());
  if (index < 0 || !std::isfinite(ground.z())) return;
  Sums& s = sums_[static_cast<std::size_t>(index)];
  if (s.n == 0) s.height = static_cast<float>(ground.z());
  const Eigen::Vector2d center =
      centerOf(static_cast<int>(index % columns_), static_cast<int>(index / columns_));
  const auto x = static_cast<float>(ground.x() - center.x());
  const auto y = static_cast<float>(ground.y() - center.y());
  const auto z = static_cast<float>(ground.z() - s.height);
  ++s.n;
  s.x += x, s.y += y, s.z += z;
  s.xx += x * x, s.xy += x * y, s.yy += y * y;
  s.xz += x * z, s.yz += y * z, s.zz += z * z;
}

std::pair<int, int> PlaneGrid::cellOf(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d at = ((place - minimum_) / cell_).array().floor();
  return {static_cast<int>(at.y()), static_cast<int>(at.x())};
}

std::optional<CellPlane> PlaneGrid::planeAt(double x, double y) const {
  const long index = indexOf(x, y);
  if (index < 0) return std::nullopt;
  return plane(static_cast<int>(index % columns_), static_cast<int>(index / columns_));
}

std::optional<CellPlane> PlaneGrid::plane(int column, int row) const {
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return std::nullopt;
  const Sums& s = sums_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(column)];
  if (s.n < 6) return std::nullopt;
  const double n = s.n, mx = s.x / n, my = s.y / n, mz = s.z / n;
  const double xx = s.xx / n - mx * mx, xy = s.xy / n - mx * my, yy = s.yy / n - my * my;
  const double xz = s.xz / n - mx * mz, yz = s.yz / n - my * mz, zz = s.zz / n - mz * mz;
  const double determinant = xx * yy - xy * xy;
  // Points in a line leave the slope across it open.
  if (determinant < 1e-4 * cell_ * cell_ * cell_ * cell_ / 144.0) return std::nullopt;
  CellPlane plane;
  plane.center = centerOf(column, row);
  plane.points = s.n;
  plane.slope_x = (xz * yy - yz * xy) / determinant;
  plane.slope_y = (yz * xx - xz * xy) / determinant;
  plane.height = s.height + mz - plane.slope_x * mx - plane.slope_y * my;
  const double variance = zz - plane.slope_x * xz - plane.slope_y * yz;
  plane.rms = std::sqrt(std::max(0.0, variance) * n / (n - 3.0));
  return plane;
}

}  // namespace pcl_als
