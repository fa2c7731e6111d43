// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

// pcl::VoxelGrid and related filters merge points through pcl::CentroidPoint, which knows how to
// average a few fields and resets all others. A strip's time, return or source id has no mean
// (points of two passes may share a voxel), so a merged PointLidar takes position and intensity as
// means and every other field, bit for bit, from its first point.

#include <cstddef>

#include <Eigen/Core>

namespace pcl {

// Declared, not included: PCL's headers that use it bring the template and copyPoint().
template <typename PointT>
class CentroidPoint;
template <typename PointInT, typename PointOutT>
void copyPoint(const PointInT& in, PointOutT& out);

template <>
class CentroidPoint<pcl_als::PointLidar> {
 public:
  void add(const pcl_als::PointLidar& point) {
    if (count_ == 0) first_ = point;
    sum_ += Eigen::Vector4d(point.x, point.y, point.z, point.intensity);
    ++count_;
  }

  template <typename PointOutT>
  void get(PointOutT& out) const {
    if (count_ == 0) return;
    const Eigen::Vector4f mean = (sum_ / static_cast<double>(count_)).template cast<float>();
    pcl_als::PointLidar merged = first_;
    merged.x = mean[0], merged.y = mean[1], merged.z = mean[2], merged.intensity = mean[3];
    pcl::copyPoint(merged, out);
  }

  std::size_t getSize() const { return count_; }

 private:
  pcl_als::PointLidar first_;
  Eigen::Vector4d sum_ = Eigen::Vector4d::Zero();
  std::size_t count_ = 0;
};

}  // namespace pcl
