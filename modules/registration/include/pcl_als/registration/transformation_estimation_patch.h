// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>

#include <pcl/registration/transformation_estimation.h>

#include <pcl_als/common/point_types.h>
#include <pcl_als/registration/patch_match_provider.h>

namespace pcl_als {

/** \brief The rigid motion that brings points closest to their patches' planes, for any
 * pcl::Registration: least squares of the normal distances (Habib et al. 2011, Eqs. (25), (34)).
 *
 * One equation for each correspondence, n'(t + theta x (p - c)) = -d with n the normal of the patch
 * and d the signed normal distance of the source point; where the other point of the
 * correspondence lies in the patch does not count. Huber weights to 1.5 robust standard deviations.
 * Directions that no patch fixes (those in the plane of flat ground) are left alone. Linearised in
 * the rotation; iterate, as pcl::IterativeClosestPoint does.
 *
 * Patches come from a CorrespondenceEstimationPointToPatch given to setMatchProvider(); without one
 * they are found in the TIN of the target cloud, which is then built at each call.
 *
 * \code
 * icp.setCorrespondenceEstimation(estimation);          // point to patch
 * icp.addCorrespondenceRejector(rejector);
 * pcl::shared_ptr<TransformationEstimationPatch<P, P>> transformation(
 *     new TransformationEstimationPatch<P, P>);
 * transformation->setMatchProvider(estimation);
 * icp.setTransformationEstimation(transformation);
 * \endcode
 */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class TransformationEstimationPatch
    : public pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar> {
 public:
  using Base = pcl::registration::TransformationEstimation<PointSource, PointTarget, Scalar>;
  using typename Base::Matrix4;
  using Ptr = pcl::shared_ptr<TransformationEstimationPatch>;
  using ConstPtr = pcl::shared_ptr<const TransformationEstimationPatch>;

  /// Takes patches from an estimation; null: finds them here.
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
  /// \param correspondences index_query counts; index_match is not used.
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

// In the library; any other registered point type with x, y, z is instantiated where it is used.
extern template class TransformationEstimationPatch<PointLidar, PointLidar, float>;
extern template class TransformationEstimationPatch<PointLidar, PointLidar, double>;
extern template class TransformationEstimationPatch<pcl::PointXYZ, pcl::PointXYZ, float>;
extern template class TransformationEstimationPatch<pcl::PointXYZ, pcl::PointXYZ, double>;

}  // namespace pcl_als
