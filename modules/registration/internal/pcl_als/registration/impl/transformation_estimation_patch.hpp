// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <limits>
#include <numeric>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/registration/patch_motion.h>
#include <pcl_als/registration/transformation_estimation_patch.h>

namespace pcl_als {

template <typename PointSource, typename PointTarget, typename Scalar>
void TransformationEstimationPatch<PointSource, PointTarget, Scalar>::estimate(
    const pcl::PointCloud<PointSource>& source, const pcl::Indices& points,
    const pcl::PointCloud<PointTarget>& target, Matrix4& transformation) const {
  CloudSurface::ConstPtr surface;
  if (!provider_) surface = makeCloudSurface(target, nullptr, 0.001);
  std::vector<PointOnPatch> found;
  found.reserve(points.size());
  std::int32_t hint = Tin::kNone;
  for (const pcl::index_t i : points) {
    if (i < 0 || static_cast<std::size_t>(i) >= source.size())
      throw UsageError("TransformationEstimationPatch: point " + std::to_string(i) + " of " +
                       std::to_string(source.size()));
    const Eigen::Vector3d point = source[i].getVector3fMap().template cast<double>();
    if (provider_) {
      if (const PatchMatch* match = provider_->findMatch(i))
        found.push_back({point, match->normal, match->signed_normal_distance});
    } else if (const auto match =
                   surface->surface.closest(point, std::numeric_limits<double>::infinity(), hint)) {
      found.push_back({point, match->normal, match->signed_normal_distance});
    }
  }
  transformation = patchMotion(found).matrix().template cast<Scalar>();
  if (provider_) provider_->markTransformationEstimated();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void TransformationEstimationPatch<PointSource, PointTarget, Scalar>::estimateRigidTransformation(
    const pcl::PointCloud<PointSource>& source, const pcl::PointCloud<PointTarget>& target,
    Matrix4& transformation) const {
  pcl::Indices all(source.size());
  std::iota(all.begin(), all.end(), 0);
  estimate(source, all, target, transformation);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void TransformationEstimationPatch<PointSource, PointTarget, Scalar>::estimateRigidTransformation(
    const pcl::PointCloud<PointSource>& source, const pcl::Indices& source_indices,
    const pcl::PointCloud<PointTarget>& target, Matrix4& transformation) const {
  estimate(source, source_indices, target, transformation);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void TransformationEstimationPatch<PointSource, PointTarget, Scalar>::estimateRigidTransformation(
    const pcl::PointCloud<PointSource>& source, const pcl::Indices& source_indices,
    const pcl::PointCloud<PointTarget>& target, const pcl::Indices& /*target_indices*/,
    Matrix4& transformation) const {
  estimate(source, source_indices, target, transformation);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void TransformationEstimationPatch<PointSource, PointTarget, Scalar>::estimateRigidTransformation(
    const pcl::PointCloud<PointSource>& source, const pcl::PointCloud<PointTarget>& target,
    const pcl::Correspondences& correspondences, Matrix4& transformation) const {
  pcl::Indices points;
  points.reserve(correspondences.size());
  for (const pcl::Correspondence& c : correspondences) points.push_back(c.index_query);
  estimate(source, points, target, transformation);
}

}  // namespace pcl_als
