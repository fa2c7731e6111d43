// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <pcl/point_cloud.h>
#include <pcl/registration/correspondence_rejection.h>

#include <pcl_als/registration/patch_match_provider.h>
#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als {

/** \brief Rejects correspondences whose patch is not worth measuring to: across eaves, in trees, on
 * ridges, at the border of the swath.
 *
 * A plain point-to-triangle adjustment that takes every triangle is biased by these, by far more
 * than its reported standard deviation. A correspondence stays if its source point has a conjugate
 * patch (the closest one, projection inside it), within the normal distance, and the patch is
 * short, not too steep, its neighbourhood smooth and level with it, and inside the TIN (see
 * PatchQuality).
 *
 * Patches come from a CorrespondenceEstimationPointToPatch given to setMatchProvider(), without a
 * second search; or, for correspondences of any other estimation, are found here in the TIN of the
 * target points, which pcl::Registration hands over (or setInputSource() and setInputTarget() do).
 * index_match of the correspondences is not used. Verdicts about triangles are kept until the
 * target or a limit changes: one byte per triangle.
 */
class CorrespondenceRejectorPatch : public pcl::registration::CorrespondenceRejector {
 public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorPatch>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorPatch>;

  /// Why correspondences went in the latest call; the first reason counts.
  struct Result {
    std::size_t kept = 0;
    std::size_t without_patch = 0;  ///< projection outside the closest patch, or none close
    std::size_t too_far = 0;        ///< normal distance
    std::size_t unfit_patch = 0;    ///< edge, slope, roughness, bend or border
  };

  CorrespondenceRejectorPatch() { rejection_name_ = "CorrespondenceRejectorPatch"; }

  void setMaximumNormalDistance(double metres);  ///< > 0; default 1 m
  void setMaximumEdgeLength(double metres);      ///< > 0, 3D; default 5 m
  void setMaximumSlope(double radians);  ///< from horizontal, in (0, pi/2]; default 1.05 (60 deg)
  void setMaximumRoughness(double metres);  ///< > 0; default 0.1 m
  void setMaximumBend(double radians);      ///< in (0, pi/2]; default 0.35 (20 degrees)
  void setRejectBorder(bool reject);        ///< patches at the border of the TIN; default true
  void setResolution(double metres);        ///< of a TIN that is built here; default 0.001 m
  double getMaximumNormalDistance() const { return normal_distance_; }
  double getMaximumEdgeLength() const { return criterion_.edge_length; }
  double getMaximumSlope() const { return criterion_.slope; }
  double getMaximumRoughness() const { return criterion_.roughness; }
  double getMaximumBend() const { return criterion_.bend; }
  bool getRejectBorder() const { return criterion_.reject_border; }
  double getResolution() const { return resolution_; }

  /// Takes patches from an estimation; null: finds them here.
  void setMatchProvider(const std::shared_ptr<const PatchMatchProvider>& provider);

  template <typename PointT>
  void setInputSource(const pcl::PointCloud<PointT>& cloud);
  template <typename PointT>
  void setInputTarget(const pcl::PointCloud<PointT>& cloud);

  bool requiresSourcePoints() const override { return !provider_; }
  bool requiresTargetPoints() const override { return !provider_; }
  void setSourcePoints(pcl::PCLPointCloud2::ConstPtr cloud) override;
  void setTargetPoints(pcl::PCLPointCloud2::ConstPtr cloud) override;

  /// UsageError if the patches cannot be known: neither provider nor clouds, or an index beyond the
  /// source.
  void getRemainingCorrespondences(const pcl::Correspondences& original_correspondences,
                                   pcl::Correspondences& remaining_correspondences) override;
  const Result& getResult() const { return result_; }

 protected:
  void applyRejection(pcl::Correspondences& correspondences) override {
    getRemainingCorrespondences(*input_correspondences_, correspondences);
  }

 private:
  enum class Verdict : std::uint8_t { unknown, fit, unfit };

  CloudSurface::ConstPtr currentSurface() const;
  bool keep(const CloudSurface& surface, pcl::index_t source_point);
  bool isFit(const PatchSurface& surface, std::int32_t triangle);
  void setLimit(double& limit, double value, double most, const char* name, const char* unit);

  /// Limits of a user's own, whatever the spacing of the points.
  static SurfaceCriterion defaultCriterion() {
    SurfaceCriterion criterion;
    criterion.edge_factor = std::numeric_limits<double>::infinity();
    criterion.minimum_vertices = 0;
    criterion.edge_length = 5.0;
    criterion.roughness = 0.1;
    criterion.bend = 0.35;
    return criterion;
  }

  double normal_distance_ = 1.0, resolution_ = 0.001;
  SurfaceCriterion criterion_ = defaultCriterion();
  std::shared_ptr<const PatchMatchProvider> provider_;
  std::vector<Eigen::Vector3f> source_;
  CloudSurface::ConstPtr target_;
  CloudSurface::ConstPtr judged_;  ///< whose triangles the verdicts are about
  std::vector<Verdict> verdicts_;
  std::int32_t hint_ = Tin::kNone;
  Result result_;
};

template <typename PointT>
void CorrespondenceRejectorPatch::setInputSource(const pcl::PointCloud<PointT>& cloud) {
  source_.clear();
  source_.reserve(cloud.size());
  for (const PointT& p : cloud) source_.push_back(p.getVector3fMap());
}

template <typename PointT>
void CorrespondenceRejectorPatch::setInputTarget(const pcl::PointCloud<PointT>& cloud) {
  target_ = makeCloudSurface(cloud, nullptr, resolution_);
}

}  // namespace pcl_als
