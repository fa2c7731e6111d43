// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Core>
#include <pcl/point_cloud.h>

namespace pcl_als::test {

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr cloudOf(const std::vector<Eigen::Vector3d>& points) {
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  for (const Eigen::Vector3d& p : points) {
    PointT point;
    point.getVector3fMap() = p.cast<float>();
    cloud->push_back(point);
  }
  return cloud;
}

}  // namespace pcl_als::test
