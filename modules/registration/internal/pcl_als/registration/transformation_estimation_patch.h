// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <pcl/registration/transformation_estimation.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/registration/cloud_surface.h>

namespace pcl_als {

/// A point and a patch that are to coincide.
struct PointOnPatch {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;               ///< of the patch, unit
  double signed_normal_distance = 0.0;  ///< normal . (point - patch), metres
};

/** \brief One step of the rigid motion that minimises the distances of points from the planes of
 * their patches: robust least squares of the normal distances. Directions in which no patch
 * determines the motion to 10 m are left unchanged; identity for fewer than six points.
 */
Eigen::Affine3d patchMotion(const std::vector<PointOnPatch>& points);

/** \brief The rigid motion that minimises the normal distances of points from their patches (least
 * squares; Habib et al. 2011, Eqs. (25), (34)), for any pcl::Registration.
 *
 * One equation for each correspondence, n'(t + theta x (p - c)) = -d with n the normal of the patch
 * and d the signed normal distance of the source point; the position of the other point of the
 * correspondence within the patch has no influence. Huber weights from 1.5 robust standard
 * deviations on. Directions that no patch determines (those in the plane of flat ground) are left
 * unchanged. Linearised in the rotation and therefore iterated, as by pcl::IterativeClosestPoint.
 *
 * Patches are those of a CorrespondenceEstimationPointToPatch given to setMatchProvider(); without
 * one they are searched in the TIN of the target cloud, which is then built at each call.
 * usePointToPatch() sets it together with the correspondence estimation and the rejector.
 */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationPatch
    : public pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar> {
 public:
  using Base = pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>;
  using typename Base::Matrix4;
  using Ptr = pcl::shared_ptr<TransformationEstimationPatch>;
  using ConstPtr = pcl::shared_ptr<const TransformationEstimationPatch>;

  /// Uses the patches of an estimation; null: searches them in the target cloud.
  void setMatchProvider(const std::shared_ptr<const PatchMatchProvider>& provider) {
    provider_ = provider;
  }
  std::shared_ptr<const PatchMatchProvider> getMatchProvider() const { return provider_; }

  void estimateRigidTransformation(const pcl::PointCloud<PointSource>& source,
                                   const pcl::PointCloud<PointTarget>& target,
                                   Matrix4& transformation) const override;
  void estimateRigidTransformation(const pcl::PointCloud<PointSource>& source,
                                   const pcl::Indices& source_indices,
                                   const pcl::PointCloud<PointTarget>& target,
                                   Matrix4& transformation) const override;
  void estimateRigidTransformation(const pcl::PointCloud<PointSource>& source,
                                   const pcl::Indices& source_indices,
                                   const pcl::PointCloud<PointTarget>& target,
                                   const pcl::Indices& target_indices,
                                   Matrix4& transformation) const override;
  /// \param correspondences of which index_query is used; index_match is not
  void estimateRigidTransformation(const pcl::PointCloud<PointSource>& source,
                                   const pcl::PointCloud<PointTarget>& target,
                                   const pcl::Correspondences& correspondences,
                                   Matrix4& transformation) const override;

 private:
  void estimate(const pcl::PointCloud<PointSource>& source, const pcl::Indices& points,
                const pcl::PointCloud<PointTarget>& target, Matrix4& transformation) const;

  std::shared_ptr<const PatchMatchProvider> provider_;
};

}  // namespace pcl_als

namespace pcl_als {

// Instantiated in the library; other registered point types with x, y, z where they are used.
extern template class TransformationEstimationPatch<PointLidar, PointLidar, float>;
extern template class TransformationEstimationPatch<PointLidar, PointLidar, double>;
extern template class TransformationEstimationPatch<pcl::PointXYZ, pcl::PointXYZ, float>;
extern template class TransformationEstimationPatch<pcl::PointXYZ, pcl::PointXYZ, double>;

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
