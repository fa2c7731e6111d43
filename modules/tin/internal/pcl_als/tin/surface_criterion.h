// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <Eigen/Core>

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

/// Division of the work of suitablePoints(): TINs of squares with margins, as in the calibration.
struct SuitablePointsSettings {
  double area_size = 50.0;    ///< metres, > 0
  double margin = 8.0;        ///< metres around a square, >= 0: more than three neighbourhoods
  double resolution = 0.001;  ///< metres, coordinate step
  /// Limit of the roughness as a multiple of the median of suitable patches with slopes up to 15
  /// degrees, in addition to SurfaceCriterion::roughness; 0: no such limit.
  double plain_roughness_factor = 3.0;
  int threads = 0;  ///< 0: all cores; the result does not depend on it

  void check() const;  ///< UsageError
};

/** \brief Which points of one strip lie on a surface that is suitable for measurement.
 *
 * A point is judged by the neighbourhood of one of the triangles around it, without the triangle's
 * own vertices, so that its own noise has no influence. Points that coincide in plan with another
 * point are judged with it where it is a vertex of the TIN, and are otherwise not suitable.
 *
 * \param points those that may be part of a surface (last returns, no vegetation, no noise),
 * finite, metres, any frame; squares are counted from its origin \return by point
 */
std::vector<bool> suitablePoints(const std::vector<Eigen::Vector3d>& points,
                                 const SurfaceCriterion& criterion,
                                 const SuitablePointsSettings& settings = {});

}  // namespace pcl_als
