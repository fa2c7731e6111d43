// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <pcl/registration/correspondence_estimation.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/registration/cloud_surface.h>

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

template <typename PointSource, typename PointTarget, typename Scalar>
void CorrespondenceEstimationPointToPatch<PointSource, PointTarget,
                                          Scalar>::setMaximumNormalDistance(double metres) {
  if (!(metres > 0.0))
    throw UsageError(this->corr_name_ + ": maximum normal distance must be more than 0 m, not " +
                     std::to_string(metres) + " m");
  maximum_normal_distance_ = metres;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>::setResolution(
    double metres) {
  if (!(metres > 0.0) || !std::isfinite(metres))
    throw UsageError(this->corr_name_ + ": resolution must be more than 0 m, not " +
                     std::to_string(metres) + " m");
  resolution_ = metres;
  this->target_cloud_updated_ = true;
}

/// A registration moves one cloud and searches again, for the same target.
template <typename PointSource, typename PointTarget, typename Scalar>
void CorrespondenceEstimationPointToPatch<PointSource, PointTarget,
                                          Scalar>::requirePatchTransformation() const {
  if (!patch_transformation_ || transformation_estimated_ || this->target_cloud_updated_) return;
  const auto searched = searched_source_.lock();
  if (!searched || searched != this->input_ ||
      static_cast<std::size_t>(searched_point_) >= searched->size() ||
      (*searched)[searched_point_].getVector3fMap() == searched_position_)
    return;
  throw UsageError(
      this->corr_name_ +
      ": the source was moved, but no transformation estimation has used the patches: call "
      "usePointToPatch(registration), or set a TransformationEstimationPatch with this estimation "
      "as match provider; for an estimation that takes normal distances itself (point to plane) "
      "call setPatchTransformationRequired(false)");
}

/// Indices of the source and patches of the target; false where the target has no patches.
template <typename PointSource, typename PointTarget, typename Scalar>
bool CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>::prepare() {
  if (!this->target_)
    throw UsageError(this->corr_name_ + ": no target; call setInputTarget with a cloud of points");
  if (!this->input_)
    throw UsageError(this->corr_name_ + ": no source; call setInputSource with a cloud of points");
  // The base's initCompute is not used: it would build a kd-tree of the target.
  pcl::PCLBase<PointSource>::initCompute();
  if (this->target_cloud_updated_ || !surface_) {
    surface_ = makeCloudSurface(*this->target_, this->target_indices_.get(), resolution_);
    this->target_cloud_updated_ = false;
  }
  return !surface_->surface.tin().triangles().empty();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>::
    determineCorrespondences(pcl::Correspondences& correspondences, double max_distance) {
  requirePatchTransformation();
  correspondences.clear();
  matches_.clear();
  match_of_point_.clear();
  searched_source_.reset();
  transformation_estimated_ = false;
  const double limit = std::min(max_distance, maximum_normal_distance_);
  if (prepare() && limit > 0.0) search(correspondences, limit);
  this->deinitCompute();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>::
    determineReciprocalCorrespondences(pcl::Correspondences& correspondences, double max_distance) {
  determineCorrespondences(correspondences, max_distance);
  if (!correspondences.empty())
    keepReciprocal(correspondences, std::min(max_distance, maximum_normal_distance_));
}

template <typename PointSource, typename PointTarget, typename Scalar>
pcl::index_t
CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>::pseudoConjugate(
    const PatchMatch& match) const {
  int nearest = 0;
  match.weights.maxCoeff(&nearest);
  return surface_->cloudIndex(surface_->surface.tin().triangles()[match.triangle].vertex[nearest]);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>::search(
    pcl::Correspondences& correspondences, double limit) {
  // Chunks of fixed size, combined in order: the result does not depend on the number of threads.
  constexpr std::size_t kChunk = 4096;
  struct Found {
    pcl::Correspondences correspondences;
    std::vector<PatchMatch> matches;
  };
  const pcl::Indices& indices = *this->indices_;
  std::vector<Found> chunks((indices.size() + kChunk - 1) / kChunk);
  parallelFor(chunks.size(), threads_, [&](std::size_t c) {
    std::int32_t hint = Tin::kNone;
    const std::size_t end = std::min(indices.size(), (c + 1) * kChunk);
    for (std::size_t i = c * kChunk; i < end; ++i) {
      const Eigen::Vector3d point =
          (*this->input_)[indices[i]].getVector3fMap().template cast<double>();
      const auto match = surface_->surface.closest(point, limit, hint);
      if (!match) continue;
      const double distance_sq = match->signed_normal_distance * match->signed_normal_distance;
      chunks[c].correspondences.emplace_back(indices[i], pseudoConjugate(*match),
                                             static_cast<float>(distance_sq));
      chunks[c].matches.push_back(*match);
    }
  });
  match_of_point_.assign(this->input_->size(), -1);
  for (const Found& found : chunks) {
    for (const pcl::Correspondence& c : found.correspondences)
      match_of_point_[c.index_query] = static_cast<std::int32_t>(correspondences.size()),
      correspondences.push_back(c);
    matches_.insert(matches_.end(), found.matches.begin(), found.matches.end());
  }
  if (correspondences.empty()) return;
  searched_source_ = this->input_;
  searched_point_ = correspondences.front().index_query;
  searched_position_ = (*this->input_)[searched_point_].getVector3fMap();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>::keepReciprocal(
    pcl::Correspondences& correspondences, double limit) {
  const CloudSurface::ConstPtr source =
      makeCloudSurface(*this->input_, this->indices_.get(), resolution_);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    const pcl::Correspondence c = correspondences[i];
    match_of_point_[c.index_query] = -1;
    const auto& vertex = (*this->target_)[c.index_match];
    const auto back =
        source->surface.closest(vertex.getVector3fMap().template cast<double>(), limit);
    if (!back) continue;
    const auto& corners = source->surface.tin().triangles()[back->triangle].vertex;
    const bool mutual = std::any_of(corners.begin(), corners.end(), [&](std::int32_t v) {
      return source->cloudIndex(v) == c.index_query;
    });
    if (!mutual) continue;
    match_of_point_[c.index_query] = static_cast<std::int32_t>(kept);
    correspondences[kept] = c;
    matches_[kept++] = matches_[i];
  }
  correspondences.resize(kept);
  matches_.resize(kept);
}

template <typename PointSource, typename PointTarget, typename Scalar>
const PatchMatch* CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>::findMatch(
    pcl::index_t source_point) const {
  if (source_point < 0 || static_cast<std::size_t>(source_point) >= match_of_point_.size())
    return nullptr;
  const std::int32_t at = match_of_point_[source_point];
  return at < 0 ? nullptr : &matches_[at];
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>::Base::Ptr
CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>::clone() const {
  return Ptr(new CorrespondenceEstimationPointToPatch(*this));
}

}  // namespace pcl_als
