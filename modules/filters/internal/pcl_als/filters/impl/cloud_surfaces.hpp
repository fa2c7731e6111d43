// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/point_fields.h>
#include <pcl_als/radiometry/local_surfaces.h>

namespace pcl_als {

/// Surfaces at the points of a cloud, of given normals or else of local planes through the single
/// and last returns. The cloud must exist as long as the object.
template <typename PointT>
class CloudSurfaces {
 public:
  using NormalsConstPtr = pcl::PointCloud<pcl::Normal>::ConstPtr;

  /// UsageError, for the filter \a name, where normals are given but not one per point.
  static void requireOnePerPoint(const NormalsConstPtr& normals, std::size_t points,
                                 const std::string& name) {
    if (normals && normals->size() != points)
      throw UsageError(name + ": " + std::to_string(normals->size()) + " normals for " +
                       std::to_string(points) + " points");
  }

  /// Whether a return is single or the last one, which are those on surfaces.
  static bool isLast(const PointFields<PointT>& point) {
    return point.returnNumber() >= point.numberOfReturns();
  }

  /// The return at a position (ground frame) and a time of the trajectory, as evaluators take it.
  static LidarReturn returnOf(const PointFields<PointT>& point, const Eigen::Vector3d& position,
                              double time) {
    LidarReturn result;
    result.position = position;
    result.time = time;
    result.return_number = point.returnNumber();
    result.number_of_returns = point.numberOfReturns();
    return result;
  }

  CloudSurfaces(const pcl::PointCloud<PointT>& cloud, NormalsConstPtr normals,
                const LocalSurfaceSettings& settings)
      : cloud_(cloud), normals_(std::move(normals)), planes_(lastReturns(), settings) {}

  LocalSurface at(std::size_t index) const {
    if (!normals_) return planes_.at(PointFields<PointT>{cloud_[index]}.position());
    LocalSurface surface;
    surface.normal = (*normals_)[index].getNormalVector3fMap().normalized();
    surface.support = 1;
    return surface;
  }

 private:
  /// None where normals are given.
  std::vector<Eigen::Vector3f> lastReturns() const {
    std::vector<Eigen::Vector3f> points;
    if (normals_) return points;
    for (const PointT& point : cloud_) {
      const PointFields<PointT> fields{point};
      if (isLast(fields) && fields.isFinite()) points.push_back(fields.position());
    }
    return points;
  }

  const pcl::PointCloud<PointT>& cloud_;
  NormalsConstPtr normals_;
  LocalSurfaces planes_;
};

}  // namespace pcl_als
