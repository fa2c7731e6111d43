// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/tin/patch_surface.h>

namespace pcl_als::registration {

/// What makes a surface smooth enough to measure to; found from the data.
struct SurfaceLimits {
  double roughness = 0.3;        ///< metres, RMS of a neighbourhood about its plane, at most
  double plain_roughness = 0.0;  ///< metres, what the noise alone makes of plain ground
};

/// Direction of a patch's neighbourhood and how well it is known.
struct PatchPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, upward
  double tilt_sigma = 0.0;                            ///< radians
};

/// A point on a smooth surface: it looks for a patch in the other cloud.
struct Candidate {
  Eigen::Vector3d position;
  PatchPlane plane;
};

/** \brief One cloud's surface in one area: TIN, points that look for patches, and which patches may
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
  /// At most \a count candidates on smooth surfaces, evenly over slopes and aspects.
  void chooseCandidates(std::size_t count, const SurfaceLimits& limits);
  /// Every n-th point of all, \a count at most; from now on this side is coarse.
  void makeCoarse(std::size_t count);

  /// The plane of a patch; false where it is not worth measuring to. Verdicts are kept: not to be
  /// called by two threads at once, unless the side is coarse.
  bool planeOf(std::int32_t triangle, PatchPlane& plane);

 private:
  bool judge(std::int32_t triangle, PatchPlane& plane) const;
  bool judgeCoarse(std::int32_t triangle, PatchPlane& plane) const;
  bool acceptable(const PatchQuality& quality) const;
  PatchPlane planeOf(const PatchQuality& quality) const;
  std::vector<std::vector<std::int32_t>> trianglesByClass() const;

  PatchSurface surface_;
  Eigen::AlignedBox2d box_;
  std::vector<Candidate> candidates_;
  SurfaceLimits limits_;
  double longest_edge_ = 0.0;  ///< metres in plan, limit
  bool coarse_ = false;
  std::vector<std::int32_t> verdicts_;  ///< by triangle: index into planes_, or kUnknown, kUnfit
  std::vector<PatchPlane> planes_;
};

}  // namespace pcl_als::registration
