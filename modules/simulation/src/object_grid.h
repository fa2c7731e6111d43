// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace pcl_als::simulation {

/** \brief Which objects may be met over each cell of a plan grid.
 *
 * walk() visits the cells under a piece of a ray, each with the ray's interval in it; the intervals
 * share their ends exactly, so an object that is listed in several cells is taken once if a hit
 * counts only in the cell whose interval holds it.
 */
class ObjectGrid {
 public:
  static constexpr double kCell = 4.0;  ///< metres

  ObjectGrid() = default;
  /// \param boxes lower and upper corner of each object in plan
  ObjectGrid(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum,
             const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& boxes);

  /// visit(first, last, from, to): objects [first, last) are those of the cell under [from, to).
  template <typename Visit>
  void walk(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double from, double to,
            Visit&& visit) const;

  /// True when no object's box touches the rectangle.
  bool emptyIn(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper) const;

 private:
  std::ptrdiff_t columnOf(double x) const { return clampTo((x - minimum_.x()) / kCell, columns_); }
  std::ptrdiff_t rowOf(double y) const { return clampTo((y - minimum_.y()) / kCell, rows_); }
  static std::ptrdiff_t clampTo(double place, std::ptrdiff_t count) {
    return static_cast<std::ptrdiff_t>(std::clamp(place, 0.0, static_cast<double>(count) - 1.0));
  }

  Eigen::Vector2d minimum_{0, 0};
  std::ptrdiff_t columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> first_;    ///< per cell, and one more
  std::vector<std::uint32_t> objects_;  ///< cell after cell
};

template <typename Visit>
void ObjectGrid::walk(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double from,
                      double to, Visit&& visit) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double x = origin.x() + from * direction.x(), y = origin.y() + from * direction.y();
  std::ptrdiff_t column = columnOf(x), row = rowOf(y);
  const int step_x = direction.x() > 0.0 ? 1 : -1, step_y = direction.y() > 0.0 ? 1 : -1;
  const double edge_x = minimum_.x() + kCell * static_cast<double>(column + (step_x > 0 ? 1 : 0));
  const double edge_y = minimum_.y() + kCell * static_cast<double>(row + (step_y > 0 ? 1 : 0));
  const double across_x = direction.x() != 0.0 ? kCell / std::abs(direction.x()) : kNever;
  const double across_y = direction.y() != 0.0 ? kCell / std::abs(direction.y()) : kNever;
  double next_x = direction.x() != 0.0 ? from + (edge_x - x) / direction.x() : kNever;
  double next_y = direction.y() != 0.0 ? from + (edge_y - y) / direction.y() : kNever;
  for (double start = from; start < to;) {
    const double end = std::min({next_x, next_y, to});
    const std::size_t cell = static_cast<std::size_t>(row * columns_ + column);
    if (first_[cell] != first_[cell + 1])
      visit(objects_.data() + first_[cell], objects_.data() + first_[cell + 1], start, end);
    if (end == next_x) {
      column = std::clamp<std::ptrdiff_t>(column + step_x, 0, columns_ - 1);
      next_x += across_x;
    }
    if (end == next_y) {
      row = std::clamp<std::ptrdiff_t>(row + step_y, 0, rows_ - 1);
      next_y += across_y;
    }
    start = end;
  }
}

}  // namespace pcl_als::simulation
