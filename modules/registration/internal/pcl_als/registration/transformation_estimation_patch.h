// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>

#include <pcl/registration/transformation_estimation.h>

#include <pcl_als/common/point_types.h>
#include <pcl_als/registration/patch_match_provider.h>

namespace pcl_als {

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

#include <pcl_als/registration/impl/transformation_estimation_patch.hpp>

namespace pcl_als {

// Instantiated in the library; other registered point types with x, y, z where they are used.
extern template class TransformationEstimationPatch<PointLidar, PointLidar, float>;
extern template class TransformationEstimationPatch<PointLidar, PointLidar, double>;
extern template class TransformationEstimationPatch<pcl::PointXYZ, pcl::PointXYZ, float>;
extern template class TransformationEstimationPatch<pcl::PointXYZ, pcl::PointXYZ, double>;

}  // namespace pcl_als
