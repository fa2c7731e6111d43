// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "point_deviations.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/processing/file_correction.h>

#include "deviation_sum.h"

namespace pcl_als {

std::string DeviationSummary::describe() const {
  if (points == 0) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "standard deviations (RMS): horizontal %.3f m, vertical %.3f m; slope known at "
                "%.0f %% of the points",
                horizontal, vertical,
                100.0 * static_cast<double>(on_surface) / static_cast<double>(points));
  return text;
}

DeviationCells::DeviationCells(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum,
                               double cell)
    : grid_(RasterGrid::covering(minimum.x() - kMargin, minimum.y() - kMargin,
                                 maximum.x() + kMargin, maximum.y() + kMargin, cell)),
      count_(grid_.cells()),
      horizontal_(grid_.cells()),
      vertical_(grid_.cells()) {}

void DeviationCells::add(const std::vector<PointDeviation>& points) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const PointDeviation& point : points) {
    const long long column = grid_.columnOf(point.x), row = grid_.rowOf(point.y);
    if (!grid_.holds(column, row) || !std::isfinite(point.horizontal)) continue;
    const std::size_t i = grid_.index(static_cast<int>(column), static_cast<int>(row));
    ++count_[i];
    horizontal_[i] += detail::squareUnits(point.horizontal);
    vertical_[i] += detail::squareUnits(point.vertical);
  }
}

Raster DeviationCells::raster() const {
  int first_column = grid_.columns, last_column = -1, first_row = grid_.rows, last_row = -1;
  for (int row = 0; row < grid_.rows; ++row) {
    for (int column = 0; column < grid_.columns; ++column) {
      if (count_[grid_.index(column, row)] == 0) continue;
      first_column = std::min(first_column, column), last_column = std::max(last_column, column);
      first_row = std::min(first_row, row), last_row = row;
    }
  }
  Raster raster;
  raster.grid = grid_;
  if (last_row < 0) first_column = first_row = last_column = last_row = 0;
  raster.grid.west = grid_.west + first_column * grid_.cell;
  raster.grid.north = grid_.north - first_row * grid_.cell;
  raster.grid.columns = last_column - first_column + 1;
  raster.grid.rows = last_row - first_row + 1;
  raster.addBand("sigma_horizontal");
  raster.addBand("sigma_vertical");
  for (int row = 0; row < raster.grid.rows; ++row) {
    for (int column = 0; column < raster.grid.columns; ++column) {
      const std::size_t from = grid_.index(first_column + column, first_row + row);
      if (count_[from] == 0) continue;
      const std::size_t to = raster.grid.index(column, row);
      raster.bands[0].values[to] =
          static_cast<float>(detail::rootMeanSquare(horizontal_[from], count_[from]));
      raster.bands[1].values[to] =
          static_cast<float>(detail::rootMeanSquare(vertical_[from], count_[from]));
    }
  }
  return raster;
}

}  // namespace pcl_als
