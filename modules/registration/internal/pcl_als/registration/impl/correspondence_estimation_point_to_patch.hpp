// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/registration/correspondence_estimation_point_to_patch.h>

namespace pcl_als {

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
