// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "ground_filter.h"

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

}  // namespace

std::vector<std::size_t> groundPoints(const std::vector<Eigen::Vector3d>& points, double cell,
                                      double largest_object) {
  if (points.empty()) return {};
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const Eigen::Vector3d& p : points)
    cloud->push_back(pcl::PointXYZ(static_cast<float>(p.x()), static_cast<float>(p.y()),
                                   static_cast<float>(p.z())));
  pcl::ApproximateProgressiveMorphologicalFilter<pcl::PointXYZ> filter;
  filter.setInputCloud(cloud);
  filter.setCellSize(static_cast<float>(cell));
  filter.setMaxWindowSize(static_cast<int>(std::ceil(largest_object / cell)));
  filter.setSlope(kSlope);
  filter.setInitialDistance(kFirstStep);
  filter.setMaxDistance(kLargestStep);
  pcl::Indices ground;
  filter.extract(ground);
  return {ground.begin(), ground.end()};
}

}  // namespace pcl_als::detail
