// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <pcl_als/tin/orientation_classes.h>
#include <pcl_als/tin/patch_surface.h>

namespace pcl_als {

/** \brief Whether a patch, or the surface around a point, is suitable for measurement: the one
 * criterion of calibration, delivery check, strip registration and correspondence rejection.
 *
 * Limits that are infinite (or zero vertices) are not applied.
 */
struct SurfaceCriterion {
  /// Longest edge against typicalPlanEdge(), both in plan: longer ones span gaps.
  double edge_factor = 3.0;
  double slope = 1.05;        ///< radians: steeper are walls or triangles across an eave
  double roughness = 0.08;    ///< metres, RMS of the neighbourhood's vertices about their plane
  int minimum_vertices = 7;   ///< in the neighbourhood
  bool reject_border = true;  ///< triangles that touch the border of the TIN
  double edge_length = std::numeric_limits<double>::infinity();  ///< metres, longest edge in space
  /// Radians, between the triangle and the plane of its neighbourhood.
  double bend = std::numeric_limits<double>::infinity();
  /// Metres, roughness of plain ground due to noise (estimated from the data), which bounds the
  /// uncertainty of a plane from below.
  double plain_roughness = 0.0;

  /// Without slope and roughness. \a median_edge: typicalPlanEdge(), metres.
  bool isSound(const PatchQuality& quality, double median_edge) const;
  bool isSatisfiedBy(const PatchQuality& quality, double median_edge) const;
  /// Standard deviation of the tilt of the neighbourhood's plane, radians.
  double tiltStd(const PatchQuality& quality) const;
};

/// Radians (15 degrees): slope limit of plain ground, whose roughness is that of the noise.
inline constexpr double kGentleSlope = 0.26;

/** \brief Typical length in plan of the edges of a TIN, metres, from a limited number of its
 * triangles; 0 for an empty one.
 *
 * The median length, or, where the points form clusters and lines (rosette scanners), the 90th
 * percentile of the longest edges of the triangles divided by 2.3 (independent points: 2.0 times
 * the median edge). In a rosette the median edge is the distance of consecutive pulses; the gaps
 * between its petals, in its outer half up to 60 % of the area, are several times as wide.
 */
double typicalPlanEdge(const Tin& tin,
                       std::size_t triangles = std::numeric_limits<std::size_t>::max());

/** \brief One triangle for each vertex that \a wanted accepts, by orientation class (every step-th
 * triangle).
 *
 * The class is that of the triangle beyond the edge opposite to the vertex. If it were that of the
 * vertex's own triangle, the noise of points chosen by class would not have zero mean.
 */
std::vector<std::vector<std::int32_t>> trianglesByOrientation(
    const PatchSurface& surface, std::size_t step,
    const std::function<bool(std::int32_t vertex)>& wanted);

/// At most \a total members, as evenly over the classes as possible, evenly within each class.
template <typename T>
std::vector<T> chosenEvenly(const std::vector<std::vector<T>>& classes, std::size_t total) {
  std::vector<std::size_t> sizes;
  sizes.reserve(classes.size());
  for (const std::vector<T>& members : classes) sizes.push_back(members.size());
  const std::vector<std::size_t> shares = evenShares(sizes, total);
  std::vector<T> chosen;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    for (std::size_t k = 0; k < shares[c]; ++k)
      chosen.push_back(classes[c][k * sizes[c] / shares[c]]);
  }
  return chosen;
}

}  // namespace pcl_als
