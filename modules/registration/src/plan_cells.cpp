// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "plan_cells.h"

#include <algorithm>

namespace pcl_als::registration {

PlanGrid::PlanGrid(const Eigen::AlignedBox2d& box, double cell_size)
    : corner(box.min()), cell(cell_size) {
  columns = 1 + static_cast<int>(box.sizes().x() / cell);
  rows = 1 + static_cast<int>(box.sizes().y() / cell);
}

LowestPoints::LowestPoints(const WorkingPoints& points, const PlanGrid& grid)
    : grid_(grid), counts_(grid.size(), 0), lowest_(grid.size()) {
  for (std::size_t i = 0; i < points.count(); ++i) {
    const Eigen::Vector3d p = points[i];
    const std::int64_t cell = grid_.cellOf(p.x(), p.y());
    if (cell < 0 || !std::isfinite(p.z())) continue;
    if (counts_[cell]++ == 0 || p.z() < lowest_[cell].z()) lowest_[cell] = p.cast<float>();
  }
}

LowestPoints LowestPoints::pooled() const {
  LowestPoints pool;
  pool.grid_ = grid_;
  pool.grid_.cell = 2.0 * grid_.cell;
  pool.grid_.columns = (grid_.columns + 1) / 2;
  pool.grid_.rows = (grid_.rows + 1) / 2;
  pool.counts_.assign(pool.grid_.size(), 0);
  pool.lowest_.resize(pool.grid_.size());
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] == 0) continue;
    const std::size_t column = i % grid_.columns / 2, row = i / grid_.columns / 2;
    const std::size_t into = row * pool.grid_.columns + column;
    if (pool.counts_[into] == 0 || lowest_[i].z() < pool.lowest_[into].z())
      pool.lowest_[into] = lowest_[i];
    pool.counts_[into] += counts_[i];
  }
  return pool;
}

std::vector<Eigen::Vector3d> LowestPoints::points() const {
  std::vector<Eigen::Vector3d> result;
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (counts_[i] > 0) result.push_back(at(i));
  return result;
}

}  // namespace pcl_als::registration
