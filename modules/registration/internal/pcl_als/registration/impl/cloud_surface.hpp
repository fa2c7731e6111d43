// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <utility>

#include <pcl_als/common/errors.h>

namespace pcl_als {

template <typename PointT>
CloudSurface::ConstPtr makeCloudSurface(const pcl::PointCloud<PointT>& cloud,
                                        const pcl::Indices* indices, double resolution) {
  auto result = std::make_shared<CloudSurface>();
  const std::size_t count = indices == nullptr ? cloud.size() : indices->size();
  std::vector<Eigen::Vector3d> points;
  points.reserve(count);
  result->kept.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const pcl::index_t at = indices == nullptr ? static_cast<pcl::index_t>(i) : (*indices)[i];
    if (at < 0 || static_cast<std::size_t>(at) >= cloud.size())
      throw UsageError("surface of a cloud: index " + std::to_string(at) + " of a cloud of " +
                       std::to_string(cloud.size()) + " points");
    const Eigen::Vector3d point = cloud[at].getVector3fMap().template cast<double>();
    if (!point.allFinite()) continue;
    points.push_back(point);
    result->kept.push_back(at);
  }
  if (indices == nullptr && points.size() == cloud.size()) {
    result->kept.clear();
    result->kept.shrink_to_fit();
  }
  result->surface = PatchSurface(Tin(std::move(points), resolution));
  return result;
}

}  // namespace pcl_als
