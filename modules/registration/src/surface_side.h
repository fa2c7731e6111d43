// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/tin/patch_surface.h>
#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als::registration {

/// Strips that are yet to be moved together, and unclassified ones, look rougher than ground is.
inline SurfaceCriterion surfaceCriterion() {
  SurfaceCriterion criterion;
  criterion.roughness = 0.3;
  return criterion;
}

/// Direction of a patch's neighbourhood and how well it is known.
struct PatchPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, upward
  double tilt_sigma = 0.0;                            ///< radians
};

/// A point on a smooth surface: it is paired with a patch of the other cloud.
struct Candidate {
  Eigen::Vector3d position;
  PatchPlane plane;
};

/** \brief One cloud's surface in one area: TIN, candidate points, and which patches may
 * be found.
 *
 * A coarse one takes every triangle that is neither long, steep nor at the border, and every point.
 */
class SurfaceSide {
 public:
  SurfaceSide() = default;
  /// \param points with a margin around \a box, which holds the candidates.
  SurfaceSide(std::vector<Eigen::Vector3d> points, const Eigen::AlignedBox2d& box,
              double resolution);

  bool isCoarse() const { return coarse_; }
  bool empty() const { return surface_.tin().triangles().empty(); }
  const PatchSurface& surface() const { return surface_; }
  const std::vector<Candidate>& candidates() const { return candidates_; }

  /// Roughness on gentle slopes at about \a count places in the box.
  void sampleRoughness(std::size_t count, std::vector<double>& values) const;
  /// At most \a count candidates on surfaces within the limits, evenly over slopes and aspects; in
  /// place of those chosen before.
  void chooseCandidates(std::size_t count, const SurfaceCriterion& criterion);
  /// Every n-th point of all, \a count at most; from now on this side is coarse.
  void makeCoarse(std::size_t count);

  /// The plane of a patch; false where it is not worth measuring to. Verdicts are kept: not to be
  /// called by two threads at once, unless the side is coarse.
  bool planeOf(std::int32_t triangle, PatchPlane& plane);

 private:
  bool judge(std::int32_t triangle, PatchPlane& plane) const;
  bool judgeCoarse(std::int32_t triangle, PatchPlane& plane) const;
  PatchPlane planeOf(const PatchQuality& quality) const;

  PatchSurface surface_;
  Eigen::AlignedBox2d box_;
  std::vector<Candidate> candidates_;
  SurfaceCriterion criterion_ = surfaceCriterion();
  double median_edge_ = 0.0;  ///< metres in plan
  bool coarse_ = false;
  std::vector<std::int32_t> verdicts_;  ///< by triangle: index into planes_, or kUnknown, kUnfit
  std::vector<PatchPlane> planes_;
};

}  // namespace pcl_als::registration
