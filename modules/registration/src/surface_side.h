// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/tin/patch_surface.h>
#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als::registration {

/// Strips before their registration, and unclassified ones, appear rougher than the ground.
inline SurfaceCriterion surfaceCriterion() {
  SurfaceCriterion criterion;
  criterion.roughness = 0.3;
  return criterion;
}

/// Direction of a patch's neighbourhood and its uncertainty.
struct PatchPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, upward
  double tilt_sigma = 0.0;                            ///< radians
};

/// A point on a smooth surface: it is paired with a patch of the other cloud.
struct Candidate {
  Eigen::Vector3d position;
  PatchPlane plane;
  PatchSearch patch = {};            ///< the last search in the other cloud
  std::int32_t judged = Tin::kNone;  ///< triangle of the other cloud that was judged last
  bool suitable = false;             ///< its verdict
  PatchPlane patch_plane = {};       ///< its plane
  double tilt_sigma = 0.0;           ///< radians, of both planes together
};

/** \brief The surface of one cloud in one area: TIN, candidate points, and the suitability of
 * patches.
 *
 * On a coarse side every point and every triangle that is neither long, steep nor at the border is
 * used.
 */
class SurfaceSide {
 public:
  SurfaceSide() = default;
  /// \param points with a margin around \a box, which contains the candidates.
  SurfaceSide(std::vector<Eigen::Vector3d> points, const Eigen::AlignedBox2d& box,
              double resolution);

  bool isCoarse() const { return coarse_; }
  bool empty() const { return surface_.tin().triangles().empty(); }
  const PatchSurface& surface() const { return surface_; }
  std::vector<Candidate>& candidates() { return choice_.candidates; }

  /// Roughness on gentle slopes at about \a count places in the box.
  void sampleRoughness(std::size_t count, std::vector<double>& values) const;
  /// At most \a count candidates on surfaces within the limits, evenly over slopes and aspects;
  /// replaces those chosen before.
  void chooseCandidates(std::size_t count, const SurfaceCriterion& criterion);
  /// Exchanges the candidates, with the limits and what is known of the patches, for others, which
  /// are none at first.
  void exchangeChoice() { std::swap(choice_, other_choice_); }
  /// Uses every n-th point, \a count at most, as candidate; the side is coarse from then on.
  void makeCoarse(std::size_t count);

  /// The patch that is conjugate to a point, a candidate of the other side; empty where there is
  /// none within \a threshold (metres) that is suitable for measurement. Results are stored, here
  /// and in the candidate, so that two threads must not call it at the same time, except on a
  /// coarse side and with different candidates.
  std::optional<PatchMatch> patchOf(Candidate& candidate, const Eigen::Vector3d& moved,
                                    double threshold);

 private:
  /// The plane of a patch; false where it is not suitable for measurement.
  bool planeOf(std::int32_t triangle, PatchPlane& plane);
  bool judge(std::int32_t triangle, PatchPlane& plane) const;
  bool judgeCoarse(std::int32_t triangle, PatchPlane& plane) const;
  PatchPlane planeOf(const PatchQuality& quality) const;

  /// Candidates within a criterion, and what is known of the patches.
  struct Choice {
    SurfaceCriterion criterion = surfaceCriterion();
    std::vector<Candidate> candidates;
    std::vector<std::int32_t> verdicts;  ///< by triangle: index into planes, or kUnknown, kUnfit
    std::vector<PatchPlane> planes;
  };

  PatchSurface surface_;
  Eigen::AlignedBox2d box_;
  Choice choice_, other_choice_;
  double median_edge_ = 0.0;  ///< metres in plan
  bool coarse_ = false;
};

}  // namespace pcl_als::registration
