// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/** \brief 2.5D Delaunay triangulation of points in plan (x, y); z rides along.
 *
 * Topology is exact: plan coordinates are rounded to \a resolution (choose the LAS scale) and all
 * predicates are evaluated on the resulting integers without error. Points that fall on the same
 * plan position are one vertex: the first in input order represents it, the others are not in the
 * TIN. Collinear input has no triangles. Deterministic: the same points in the same order give the
 * same triangles in the same order.
 */
class Tin {
 public:
  static constexpr std::int32_t kNone = -1;

  struct Triangle {
    std::array<std::int32_t, 3> vertex;  ///< point indices, counter-clockwise seen from above
    std::array<std::int32_t, 3>
        neighbour;  ///< triangle across the edge opposite vertex[i]; kNone on the hull
  };

  Tin() = default;
  /// \param points x y z, metres, plan extent at most 2^24 resolutions (else UsageError);
  /// non-finite: InputError
  explicit Tin(std::vector<Eigen::Vector3d> points, double resolution = 0.001);

  const std::vector<Eigen::Vector3d>& points() const;
  const std::vector<Triangle>& triangles() const;
  std::size_t mergedPoints() const;  ///< how many points fell on an earlier one in plan

  /// Moves the points without changing the topology; for corrections far below the point spacing.
  /// Same count.
  void movePoints(std::vector<Eigen::Vector3d> points);

  /// The triangle whose plan projection holds (x, y), edges included; kNone outside the hull.
  /// Thread-safe; \a hint is where the walk starts (kNone: from a grid of starting triangles).
  std::int32_t locate(double x, double y, std::int32_t hint = kNone) const;
};

}  // namespace pcl_als
