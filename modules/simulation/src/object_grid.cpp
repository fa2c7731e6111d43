// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "object_grid.h"

namespace pcl_als::simulation {

ObjectGrid::ObjectGrid(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum,
                       const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& boxes)
    : minimum_(minimum) {
  columns_ = static_cast<std::ptrdiff_t>(std::ceil((maximum.x() - minimum.x()) / kCell)) + 1;
  rows_ = static_cast<std::ptrdiff_t>(std::ceil((maximum.y() - minimum.y()) / kCell)) + 1;
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  // A ray's place in plan is rounded: a box reaches a little further than its object.
  const Eigen::Vector2d slack = Eigen::Vector2d::Constant(1e-6);
  const auto eachCell = [&](std::size_t object, const auto& action) {
    const Eigen::Vector2d lower = boxes[object].first - slack;
    const Eigen::Vector2d upper = boxes[object].second + slack;
    for (std::ptrdiff_t row = rowOf(lower.y()); row <= rowOf(upper.y()); ++row)
      for (std::ptrdiff_t column = columnOf(lower.x()); column <= columnOf(upper.x()); ++column)
        action(static_cast<std::size_t>(row * columns_ + column));
  };
  for (std::size_t i = 0; i < boxes.size(); ++i)
    eachCell(i, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  objects_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    eachCell(i, [&](std::size_t cell) { objects_[next[cell]++] = static_cast<std::uint32_t>(i); });
}

bool ObjectGrid::emptyIn(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper) const {
  const std::ptrdiff_t left = columnOf(lower.x()), right = columnOf(upper.x());
  for (std::ptrdiff_t row = rowOf(lower.y()); row <= rowOf(upper.y()); ++row)
    if (first_[static_cast<std::size_t>(row * columns_ + left)] !=
        first_[static_cast<std::size_t>(row * columns_ + right) + 1])
      return false;
  return true;
}

}  // namespace pcl_als::simulation
