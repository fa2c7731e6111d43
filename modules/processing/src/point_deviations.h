// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/raster.h>

namespace pcl_als {

/// A corrected point with its standard deviations (PointUncertainty), metres.
struct PointDeviation {
  double x = 0.0, y = 0.0;
  float horizontal = 0.0F, vertical = 0.0F;
};

/** \brief Root mean squares of the standard deviations of points in square cells.
 *
 * Sums are whole numbers, so that neither threads nor the order of the points change a bit.
 * Memory: 20 bytes for each cell of the grid.
 */
class DeviationCells {
 public:
  /// \param minimum, maximum box of the points as delivered, metres; those that a correction moves
  /// by less than kMargin beyond it are still within the grid
  /// \param cell side of a cell, metres
  DeviationCells(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, double cell);
  static constexpr double kMargin = 50.0;

  void add(const std::vector<PointDeviation>& points);
  /// Bands sigma_horizontal and sigma_vertical (metres), of the cells with points.
  Raster raster() const;

 private:
  RasterGrid grid_;
  std::mutex mutex_;
  std::vector<std::uint32_t> count_;
  std::vector<std::uint64_t> horizontal_, vertical_;
};

}  // namespace pcl_als
