// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <string>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/registration/correspondence_rejection_patch.h>

namespace pcl_als {
namespace {

constexpr double kQuarterTurn = 1.5707963267948966;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

pcl::PointCloud<pcl::PointXYZ> positionsOf(const pcl::PCLPointCloud2& blob) {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  pcl::fromPCLPointCloud2(blob, cloud);
  return cloud;
}

}  // namespace

void CorrespondenceRejectorPatch::setLimit(double& limit, double value, double most,
                                           const char* name, const char* unit) {
  if (!(value > 0.0) || value > most)
    throw UsageError(rejection_name_ + ": " + name + " must be more than 0 " + unit +
                     (most < kUnlimited ? " and at most " + std::to_string(most) : "") + ", not " +
                     std::to_string(value) + " " + unit);
  limit = value;
  judged_.reset();
}

void CorrespondenceRejectorPatch::setMaximumNormalDistance(double metres) {
  setLimit(normal_distance_, metres, kUnlimited, "maximum normal distance", "m");
}
void CorrespondenceRejectorPatch::setMaximumEdgeLength(double metres) {
  setLimit(criterion_.edge_length, metres, kUnlimited, "maximum edge length", "m");
}
void CorrespondenceRejectorPatch::setMaximumSlope(double radians) {
  setLimit(criterion_.slope, radians, kQuarterTurn, "maximum slope", "rad");
}
void CorrespondenceRejectorPatch::setMaximumRoughness(double metres) {
  setLimit(criterion_.roughness, metres, kUnlimited, "maximum roughness", "m");
}
void CorrespondenceRejectorPatch::setMaximumBend(double radians) {
  setLimit(criterion_.bend, radians, kQuarterTurn, "maximum bend", "rad");
}
void CorrespondenceRejectorPatch::setRejectBorder(bool reject) {
  criterion_.reject_border = reject;
  judged_.reset();
}
void CorrespondenceRejectorPatch::setResolution(double metres) {
  setLimit(resolution_, metres, std::numeric_limits<double>::max(), "resolution", "m");
}

void CorrespondenceRejectorPatch::setMatchProvider(
    const std::shared_ptr<const PatchMatchProvider>& provider) {
  provider_ = provider;
}

void CorrespondenceRejectorPatch::setSourcePoints(pcl::PCLPointCloud2::ConstPtr cloud) {
  setInputSource(positionsOf(*cloud));
}

void CorrespondenceRejectorPatch::setTargetPoints(pcl::PCLPointCloud2::ConstPtr cloud) {
  setInputTarget(positionsOf(*cloud));
}

CloudSurface::ConstPtr CorrespondenceRejectorPatch::currentSurface() const {
  CloudSurface::ConstPtr surface = provider_ ? provider_->getSurface() : target_;
  if (!surface)
    throw UsageError(rejection_name_ +
                     ": no patches; call setInputTarget, or setMatchProvider with an estimation "
                     "that has determined correspondences");
  return surface;
}

bool CorrespondenceRejectorPatch::isFit(const PatchSurface& surface, std::int32_t triangle) {
  Verdict& verdict = verdicts_[triangle];
  if (verdict == Verdict::unknown)
    verdict =
        criterion_.isSatisfiedBy(surface.quality(triangle), 1.0) ? Verdict::fit : Verdict::unfit;
  return verdict == Verdict::fit;
}

bool CorrespondenceRejectorPatch::keep(const CloudSurface& surface, pcl::index_t source_point) {
  std::optional<PatchMatch> match;
  if (provider_) {
    if (const PatchMatch* known = provider_->findMatch(source_point)) match = *known;
  } else {
    if (source_point < 0 || static_cast<std::size_t>(source_point) >= source_.size())
      throw UsageError(rejection_name_ + ": a correspondence names source point " +
                       std::to_string(source_point) + " of " + std::to_string(source_.size()) +
                       "; call setInputSource with the cloud it belongs to");
    match = surface.surface.closest(source_[source_point].cast<double>(), kUnlimited, hint_);
  }
  if (!match) {
    ++result_.without_patch;
  } else if (std::abs(match->signed_normal_distance) > normal_distance_) {
    ++result_.too_far;
  } else if (!isFit(surface.surface, match->triangle)) {
    ++result_.unfit_patch;
  } else {
    ++result_.kept;
    return true;
  }
  return false;
}

void CorrespondenceRejectorPatch::getRemainingCorrespondences(
    const pcl::Correspondences& original_correspondences,
    pcl::Correspondences& remaining_correspondences) {
  const CloudSurface::ConstPtr surface = currentSurface();
  if (surface != judged_) {
    judged_ = surface;
    verdicts_.assign(surface->surface.tin().triangles().size(), Verdict::unknown);
    hint_ = Tin::kNone;
  }
  result_ = Result();
  pcl::Correspondences remaining;  // the two arguments may be one
  remaining.reserve(original_correspondences.size());
  for (const pcl::Correspondence& c : original_correspondences)
    if (keep(*surface, c.index_query)) remaining.push_back(c);
  remaining_correspondences.swap(remaining);
}

}  // namespace pcl_als
