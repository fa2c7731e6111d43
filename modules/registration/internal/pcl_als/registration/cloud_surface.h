// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <vector>

#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include <pcl_als/tin/patch_surface.h>

namespace pcl_als {

/** \brief The patches of a cloud, with the point of the cloud at each vertex.
 *
 * Points with a coordinate that is not finite are excluded. Fewer than three points, or points in
 * one line in plan, give a surface without patches. Memory: that of Tin, and 4 bytes per point
 * where points were excluded.
 */
struct CloudSurface {
  using ConstPtr = std::shared_ptr<const CloudSurface>;

  PatchSurface surface;
  std::vector<pcl::index_t> kept;  ///< cloud index of each TIN point; empty if all are in, in order

  /// Cloud index of a point of the TIN.
  pcl::index_t cloudIndex(std::int32_t tin_point) const {
    return kept.empty() ? tin_point : kept[tin_point];
  }
};

/// The surface of a cloud, or of the points \a indices (null: all); \a resolution as for Tin,
/// metres.
template <typename PointT>
CloudSurface::ConstPtr makeCloudSurface(const pcl::PointCloud<PointT>& cloud,
                                        const pcl::Indices* indices, double resolution);

}  // namespace pcl_als

#include <pcl_als/registration/impl/cloud_surface.hpp>
