// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include <pcl_als/common/errors.h>
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

/// Provides the patches of source points to a rejector and to a transformation estimation, so that
/// these do not search them again.
class PatchMatchProvider {
 public:
  virtual ~PatchMatchProvider() = default;
  /// The target's patches; null before the first search.
  virtual CloudSurface::ConstPtr getSurface() const = 0;
  /// The match of a source point in the latest search; null where it has none.
  virtual const PatchMatch* findMatch(pcl::index_t source_point) const = 0;
  /// Called by a transformation estimation that has used the matches of the latest search.
  virtual void markTransformationEstimated() const = 0;
};

}  // namespace pcl_als
