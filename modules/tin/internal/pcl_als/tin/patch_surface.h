// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/tin/tin.h>

namespace pcl_als {

/// A point's closest TIN patch (triangle).
struct PatchMatch {
  std::int32_t triangle = Tin::kNone;
  Eigen::Vector3d normal;   ///< unit, upward
  Eigen::Vector3d foot;     ///< the point projected onto the patch's plane
  Eigen::Vector3d weights;  ///< barycentric coordinates of foot; all >= 0: inside
  double signed_normal_distance =
      0.0;  ///< normal . (point - foot), metres; positive above the patch
};

/// Properties of the surface around a triangle, from which its suitability for measurement follows.
struct PatchQuality {
  /// Normal of the plane of the vertices around the triangle, without its own: less noisy than the
  /// triangle's, and independent of its noise. Unit, upward.
  Eigen::Vector3d plane_normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d plane_centre = Eigen::Vector3d::Zero();  ///< a point of that plane
  /// Root of the summed squares of the distances of the vertices from their centre along the
  /// narrower direction in the plane, metres: heights with noise sigma tilt the plane by sigma /
  /// spread radians.
  float spread = 0.0F;
  float longest_edge = 0.0F;  ///< metres, 3D
  float slope = 0.0F;         ///< radians from horizontal
  float roughness =
      0.0F;  ///< RMS distance of the neighbourhood's vertices from their plane, metres
  float bend =
      0.0F;  ///< angle between the triangle's normal and the neighbourhood plane's normal, radians
  std::uint16_t vertices =
      0;                 ///< in the neighbourhood (the triangles that share a vertex with this one)
  bool on_hull = false;  ///< touches the border of the TIN: one of its vertices lies on it
};

struct SurfaceCriterion;

/// What a search found for a point: the next one, after a small movement of the point, mostly finds
/// the same triangle and need not search.
struct PatchSearch {
  std::int32_t under = Tin::kNone;     ///< triangle in plan, where a search starts
  std::int32_t triangle = Tin::kNone;  ///< the closest one; kNone: none within the distance
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of the last search
  double within = 0.0;                              ///< metres, of the last search
  double movement = 0.0;  ///< metres: after shorter ones the same triangle is closest
};

/** \brief The triangles of a TIN as patches: unit normals, quality, and closest-patch search.
 *
 * Const member functions are thread-safe and use the current positions of the points; nothing is
 * stored besides the TIN.
 *
 * \code
 * const PatchSurface surface(Tin(points, 0.001));
 * std::int32_t hint = Tin::kNone;                       // one per thread
 * for (const Eigen::Vector3d& p : other_strip)          // in the order they were measured
 *   if (const auto match = surface.closest(p, 0.5, hint))
 *     if (surface.quality(match->triangle).roughness < 0.05F) use(p, *match);
 * \endcode
 */
class PatchSurface {
 public:
  PatchSurface() = default;
  explicit PatchSurface(Tin tin);
  const Tin& tin() const { return tin_; }
  Eigen::Vector3d normal(std::int32_t triangle) const;  ///< unit, upward
  PatchQuality quality(std::int32_t triangle) const;    ///< computed on request; constant time
  /// The quality of a triangle that satisfies a criterion (SurfaceCriterion::isSatisfiedBy());
  /// where it does not, only what is needed to know that is computed.
  std::optional<PatchQuality> suitable(std::int32_t triangle, const SurfaceCriterion& criterion,
                                       double median_edge) const;

  /** \brief The patch conjugate to a point (Habib et al. 2011, section 2.3.1): the closest triangle
   * in 3D, if the projection of the point along its normal lies inside it and the normal distance
   * is at most \a max_normal_distance. Empty when the closest triangle fails either condition, or
   * when there is none within the distance. Equal to an exhaustive search; of equally close
   * triangles the one with the lowest index.
   *
   * Projections that miss an edge by less than 1e-12 of the triangle count as on it. A point that
   * is not finite has no patch. \a max_normal_distance: metres, > 0 (else UsageError); may be
   * infinite.
   */
  std::optional<PatchMatch> closest(const Eigen::Vector3d& point, double max_normal_distance) const;

  /// The same, faster for points in spatial order: \a hint is the triangle under the previous point
  /// (kNone at first) and becomes that under this one.
  std::optional<PatchMatch> closest(const Eigen::Vector3d& point, double max_normal_distance,
                                    std::int32_t& hint) const;

  /// The same for a point that moves little from one call to the next, while the TIN does not: the
  /// triangle of the last search is taken while no other one can be closer. \a margin (metres) is
  /// the largest movement that needs no search; after a larger one since the last search, other
  /// triangles than the closest are not looked at, and the next call searches again.
  std::optional<PatchMatch> closest(const Eigen::Vector3d& point, double max_normal_distance,
                                    double margin, PatchSearch& last) const;

  /// The patch above or below a point in plan (for vertical control); empty outside the hull. Its
  /// signed_normal_distance is along the normal; weights are those of the vertical projection.
  std::optional<PatchMatch> vertical(const Eigen::Vector3d& point) const;

  void movePoints(std::vector<Eigen::Vector3d> points);  ///< as Tin::movePoints; normals follow

 private:
  std::optional<PatchQuality> examine(std::int32_t triangle, const SurfaceCriterion* criterion,
                                      double median_edge) const;

  Tin tin_;
};

}  // namespace pcl_als
