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

#include <pcl_als/registration/cloud_surface.h>
#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als {

/** \brief Rejects correspondences whose patch is not suitable for measurement: across eaves, in
 * trees, on ridges, at the border of the swath.
 *
 * An adjustment with all triangles is biased by such patches, by far more than its reported
 * standard deviation. A correspondence is kept if its source point has a conjugate patch (the
 * closest one, with the projection inside it) within the limit of the normal distance, and if the
 * patch has short edges, is not too steep, has a smooth neighbourhood of the same orientation, and
 * is inside the TIN (see PatchQuality).
 *
 * Patches are those of a CorrespondenceEstimationPointToPatch given to setMatchProvider(), without
 * a second search. For correspondences of any other estimation they are searched in the TIN of the
 * target points, which are set by pcl::Registration (or by setInputSource() and setInputTarget()).
 * index_match of the correspondences is not used. The suitability of triangles is stored until the
 * target or a limit changes: one byte per triangle.
 */
class CorrespondenceRejectorPatch : public pcl::registration::CorrespondenceRejector {
 public:
  using Ptr = pcl::shared_ptr<CorrespondenceRejectorPatch>;
  using ConstPtr = pcl::shared_ptr<const CorrespondenceRejectorPatch>;

  /// Numbers of rejected correspondences in the latest call, by the first reason that applies.
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

  /// Uses the patches of an estimation; null: searches them in the target cloud.
  void setMatchProvider(const std::shared_ptr<const PatchMatchProvider>& provider);

  template <typename PointT>
  void setInputSource(const pcl::PointCloud<PointT>& cloud);
  template <typename PointT>
  void setInputTarget(const pcl::PointCloud<PointT>& cloud);

  bool requiresSourcePoints() const override { return !provider_; }
  bool requiresTargetPoints() const override { return !provider_; }
  void setSourcePoints(pcl::PCLPointCloud2::ConstPtr cloud) override;
  void setTargetPoints(pcl::PCLPointCloud2::ConstPtr cloud) override;

  /// UsageError if patches cannot be determined: neither provider nor clouds, or an index beyond
  /// the source.
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

  /// Limits set by the user, independent of the spacing of the points.
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
  CloudSurface::ConstPtr judged_;  ///< the surface of the stored suitability of triangles
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
