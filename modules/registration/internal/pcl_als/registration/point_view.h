// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

#include <Eigen/Core>
#include <pcl/point_cloud.h>
#include <pcl/types.h>

namespace pcl_als {

/** \brief The positions of a cloud of any point type, without a copy.
 *
 * position(i) = origin + the floats x, y, z of the i-th point, or of the i-th of the indices. Valid
 * as long as cloud and indices exist.
 */
struct PointView {
  const std::byte* first = nullptr;  ///< the x of the first point
  std::size_t stride = 0;            ///< bytes from one point to the next
  std::size_t count = 0;             ///< points, or indices where there are some
  const pcl::index_t* indices = nullptr;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< metres, ground frame

  Eigen::Vector3d position(std::size_t i) const {
    const std::size_t at = indices == nullptr ? i : static_cast<std::size_t>(indices[i]);
    const auto* xyz = reinterpret_cast<const float*>(first + at * stride);
    return origin + Eigen::Vector3d(xyz[0], xyz[1], xyz[2]);
  }
};

/// The points of a cloud, or those of \a indices (null: all); x, y, z must be contiguous, as in all
/// point types of PCL. \a indices must be valid.
template <typename PointT>
PointView viewOf(const pcl::PointCloud<PointT>& cloud, const pcl::Indices* indices = nullptr,
                 const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  PointView view;
  if (!cloud.empty()) view.first = reinterpret_cast<const std::byte*>(&cloud.points[0].x);
  view.stride = sizeof(PointT);
  view.count = indices == nullptr ? cloud.size() : indices->size();
  view.indices = indices == nullptr ? nullptr : indices->data();
  view.origin = origin;
  return view;
}

}  // namespace pcl_als
