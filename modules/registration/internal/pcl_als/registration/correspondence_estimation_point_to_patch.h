// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <limits>
#include <vector>

#include <pcl/registration/correspondence_estimation.h>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/registration/patch_match_provider.h>

namespace pcl_als {

/** \brief For each source point, the conjugate TIN patch of the target (Habib et al. 2011, section
 * 2.3.1), for any pcl::Registration.
 *
 * A patch is conjugate to a point if it is the closest triangle of the target's 2.5D Delaunay TIN,
 * the normal distance is at most a limit and the projection of the point lies inside the triangle.
 * Each pcl::Correspondence contains
 *   index_query  the source point,
 *   index_match  the vertex of the patch nearest to the projection: the pseudo-conjugate point of
 *                Eq. (20), for which any vertex would do as only the normal direction counts,
 *   distance     the **squared normal distance**, m^2: squared as everywhere in PCL, and from the
 *                patch, not from that vertex.
 * getMatches() gives patch, normal, foot and signed normal distance beside them.
 *
 * Frames: both clouds in one local frame, z up, metres. The surface must have one height at a plan
 * position; under overhangs and in trees the TIN is not a surface, and CorrespondenceRejectorPatch
 * rejects its patches. The TIN of the target is built when a new target was set; pcl::Registration
 * does that once for each align(). Points that are not finite are excluded from both clouds. A
 * target of fewer than three points, or of points in one line, has no patches and gives no
 * correspondences. Memory: 73 bytes per target point, 4 per source point and 100 per
 * correspondence.
 *
 * **The transformation has to be estimated from the patches**, by TransformationEstimationPatch
 * with this estimation as match provider. PCL's point-to-point estimation (the default of
 * pcl::IterativeClosestPoint) would pull each point towards a vertex of its patch and stop short of
 * the solution. An iteration in which no such estimation has used the matches is
 * therefore a UsageError; usePointToPatch() sets all parts of a registration.
 *
 * \code
 * pcl::IterativeClosestPoint<pcl_als::PointLidar, pcl_als::PointLidar> icp;
 * const auto parts = pcl_als::usePointToPatch(icp);  // <pcl_als/registration/point_to_patch.h>
 * parts.correspondences->setMaximumNormalDistance(2.0);
 * icp.setInputSource(strip1);
 * icp.setInputTarget(strip2);
 * icp.setMaximumIterations(40);
 * icp.align(aligned);
 * \endcode
 */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class CorrespondenceEstimationPointToPatch
    : public pcl::registration::CorrespondenceEstimationBase<PointSource, PointTarget, Scalar>,
      public PatchMatchProvider {
 public:
  using Base = pcl::registration::CorrespondenceEstimationBase<PointSource, PointTarget, Scalar>;
  using Ptr = pcl::shared_ptr<CorrespondenceEstimationPointToPatch>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceEstimationPointToPatch>;

  CorrespondenceEstimationPointToPatch() {
    this->corr_name_ = "CorrespondenceEstimationPointToPatch";
  }

  /// Metres, > 0; the smaller of this and the distance given by the registration holds. Default 1.
  void setMaximumNormalDistance(double metres);
  double getMaximumNormalDistance() const { return maximum_normal_distance_; }

  /// Step of plan coordinates, metres, > 0: points closer than that are one vertex. Default 0.001.
  void setResolution(double metres);
  double getResolution() const { return resolution_; }

  /// 0: all cores; the result does not depend on it. Default 0.
  void setNumberOfThreads(int threads) { threads_ = requiredThreads(threads); }
  int getNumberOfThreads() const { return threads_; }

  /// Whether the transformation estimation has to use the patches; default true. False allows an
  /// estimation that takes normal distances from the normals of the target points, as
  /// pcl::registration::TransformationEstimationPointToPlaneLLS, or that searches patches itself.
  void setPatchTransformationRequired(bool required) { patch_transformation_ = required; }
  bool getPatchTransformationRequired() const { return patch_transformation_; }

  /// \param max_distance metres, of the normal distance. UsageError without source or target, and
  /// where the source cloud was moved although no estimation has used the matches of the last
  /// search (setPatchTransformationRequired()).
  void determineCorrespondences(pcl::Correspondences& correspondences,
                                double max_distance = std::numeric_limits<double>::max()) override;

  /// Of these, the ones that hold in both directions: the patch of the source's own TIN that is
  /// conjugate to index_match has index_query as a vertex. Builds a TIN of the source each time.
  void determineReciprocalCorrespondences(
      pcl::Correspondences& correspondences,
      double max_distance = std::numeric_limits<double>::max()) override;

  typename Base::Ptr clone() const override;

  /// The patches of the latest correspondences, in their order.
  const std::vector<PatchMatch>& getMatches() const { return matches_; }
  CloudSurface::ConstPtr getSurface() const override { return surface_; }
  const PatchMatch* findMatch(pcl::index_t source_point) const override;
  void markTransformationEstimated() const override { transformation_estimated_ = true; }

 private:
  void requirePatchTransformation() const;
  bool prepare();
  void search(pcl::Correspondences& correspondences, double limit);
  void keepReciprocal(pcl::Correspondences& correspondences, double limit);
  pcl::index_t pseudoConjugate(const PatchMatch& match) const;

  double maximum_normal_distance_ = 1.0;
  double resolution_ = 0.001;
  int threads_ = 0;
  bool patch_transformation_ = true;
  CloudSurface::ConstPtr surface_;
  std::vector<PatchMatch> matches_;
  std::vector<std::int32_t> match_of_point_;  ///< index into matches_ by source point; -1: none
  // Of the latest search: the source cloud, its first matched point with the position at that time,
  // and whether a transformation was estimated from the matches.
  pcl::weak_ptr<const pcl::PointCloud<PointSource>> searched_source_;
  pcl::index_t searched_point_ = 0;
  Eigen::Vector3f searched_position_ = Eigen::Vector3f::Zero();
  mutable bool transformation_estimated_ = false;
};

}  // namespace pcl_als

#include <pcl_als/registration/impl/correspondence_estimation_point_to_patch.hpp>

namespace pcl_als {

// In the library; any other registered point type with x, y, z is instantiated where it is used.
extern template class CorrespondenceEstimationPointToPatch<PointLidar, PointLidar, float>;
extern template class CorrespondenceEstimationPointToPatch<PointLidar, PointLidar, double>;
extern template class CorrespondenceEstimationPointToPatch<pcl::PointXYZ, pcl::PointXYZ, float>;
extern template class CorrespondenceEstimationPointToPatch<pcl::PointXYZ, pcl::PointXYZ, double>;
extern template class CorrespondenceEstimationPointToPatch<pcl::PointXYZI, pcl::PointXYZI, float>;
extern template class CorrespondenceEstimationPointToPatch<pcl::PointXYZI, pcl::PointXYZI, double>;
extern template class CorrespondenceEstimationPointToPatch<pcl::PointNormal, pcl::PointNormal,
                                                           float>;
extern template class CorrespondenceEstimationPointToPatch<pcl::PointNormal, pcl::PointNormal,
                                                           double>;
extern template class CorrespondenceEstimationPointToPatch<pcl::PointXYZINormal,
                                                           pcl::PointXYZINormal, float>;
extern template class CorrespondenceEstimationPointToPatch<pcl::PointXYZINormal,
                                                           pcl::PointXYZINormal, double>;

}  // namespace pcl_als
