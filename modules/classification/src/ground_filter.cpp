// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "ground_filter.h"

#include <algorithm>
#include <cmath>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/approximate_progressive_morphological_filter.h>
#include <pcl/segmentation/impl/approximate_progressive_morphological_filter.hpp>

namespace pcl_als::detail {
namespace {

// Zhang et al. 2003 with a steeper slope and a first step that passes the noise of a scanner; the
// largest step is under the eaves of a house.
constexpr float kFirstStep = 0.3F, kLargestStep = 2.5F, kSlope = 0.5F;
constexpr double kLeastCell = 1.0;  // metres

/// Cells of the raster in one of the filter's.
int cellsPerBin(double cell) {
  return std::max(1, static_cast<int>(std::ceil(kLeastCell / cell - 1e-9)));
}

int windowOf(double cell, double largest_object) {
  return static_cast<int>(std::ceil(largest_object / (cell * cellsPerBin(cell))));
}

long long binOf(long long cell, int per_bin) {
  return cell >= 0 ? cell / per_bin : -((-cell + per_bin - 1) / per_bin);
}

}  // namespace

std::vector<std::size_t> groundReturns(const RasterGrid& grid,
                                       const std::vector<LowestReturn>& returns,
                                       double largest_object) {
  if (returns.empty()) return {};
  const int per_bin = cellsPerBin(grid.cell);
  const long long west = std::llround(grid.west / grid.cell),
                  north = std::llround(-grid.north / grid.cell);
  const long long first_column = binOf(west, per_bin), first_row = binOf(north, per_bin);
  // The filter is given numbers of bins for x and y: exact in its floats, at any coordinates.
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  cloud->reserve(returns.size());
  for (const LowestReturn& point : returns)
    cloud->push_back(
        pcl::PointXYZ(static_cast<float>(binOf(west + point.column, per_bin) - first_column),
                      static_cast<float>(binOf(north + point.row, per_bin) - first_row), point.z));
  pcl::ApproximateProgressiveMorphologicalFilter<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setCellSize(1.0F);
  filter.setMaxWindowSize(windowOf(grid.cell, largest_object));
  filter.setSlope(kSlope * static_cast<float>(grid.cell * per_bin));
  filter.setInitialDistance(kFirstStep);
  filter.setMaxDistance(kLargestStep);
  pcl::Indices ground;
  filter.extract(ground);
  return {ground.begin(), ground.end()};
}

double groundFilterReach(double cell, double largest_object) {
  // Windows of 3, 5, 9, … until one is not smaller than the largest object; an opening looks as far
  // as its window is wide, and each works on the result of the one before.
  const int window = windowOf(cell, largest_object);
  int reach = 0;
  for (int half = 1;; half *= 2) {
    reach += 2 * half;
    if (2 * half + 1 >= window) break;
  }
  return (reach + 1) * cell * cellsPerBin(cell);
}

}  // namespace pcl_als::detail
