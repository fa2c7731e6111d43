// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Planes through the points of a surface in cells of some ten point spacings, whose tilt is
 * some ten times better known than that of the vertices around one triangle.
 *
 * On ground with a gentle slope the tilt of some triangles exceeds a limit of significance and that
 * of others does not, by their noise alone. Measured along their own normals the ones, and
 * vertically the others, pairs of one slope would have different rows, as if the ground were
 * undulated; this difference would count as information about plan positions.
 */
class GroundPlanes {
 public:
  struct Plane {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, upward
    double tilt_std = 0.0;                              ///< radians, along the worse axis
  };

  GroundPlanes() = default;
  /// Finds the planes robustly. \param cell side of the cells, metres; \param roughness metres:
  /// cells whose points have a larger robust standard deviation from their plane have none.
  GroundPlanes(const std::vector<Eigen::Vector3d>& points, double cell, double roughness);

  /// Fits the planes again to their points, which may have moved.
  void fit(const std::vector<Eigen::Vector3d>& points);

  /// The plane of the first of three points; null where one of them lies on none.
  const Plane* under(const std::array<std::int32_t, 3>& triangle) const;

 private:
  std::vector<std::int32_t> plane_of_;  ///< by point; -1: none
  std::vector<Plane> planes_;
};

}  // namespace pcl_als
