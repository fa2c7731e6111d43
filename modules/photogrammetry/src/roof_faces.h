// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/photogrammetry/roof_lines.h>
#include <pcl_als/tin/patch_surface.h>

namespace pcl_als::photogrammetry {

/** \brief A plane z = z0 + slope . (xy - centre) fitted to points, and its covariance.
 *
 * Least squares of vertical distances: the points have errors mainly along the pulse, and their
 * scatter about the plane gives the variance.
 */
struct FittedPlane {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();      ///< mean of the points, metres
  Eigen::Vector3d unknown = Eigen::Vector3d::Zero();     ///< z0 - centre.z, slopes by x and y
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of these
  double sigma = 0.0;                                    ///< metres, vertical, about the plane
  std::size_t points = 0;

  Eigen::Vector3d normal() const {
    return Eigen::Vector3d(-unknown[1], -unknown[2], 1.0).normalized();
  }
  /// Vertical distance of a point above the plane, and along the normal.
  double above(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d d = p - centre;
    return d.z() - unknown[0] - unknown[1] * d.x() - unknown[2] * d.y();
  }
  double distance(const Eigen::Vector3d& p) const { return above(p) * normal().z(); }
  double slope() const;  ///< radians
};
FittedPlane fitPlane(const std::vector<Eigen::Vector3d>& points,
                     const std::vector<std::int32_t>& which);
/// The same with a covariance that allows for deviations which neighbouring points have in common
/// (roofs that are not plane): points in one cell of this side (metres) may be correlated.
FittedPlane fitPlaneInCells(const std::vector<Eigen::Vector3d>& points,
                            const std::vector<std::int32_t>& which, double side);

/// A planar face.
struct RoofFace {
  FittedPlane plane;
  std::vector<std::int32_t> vertices, triangles;
  double area = 0.0;        ///< m^2 in plan
  double step_share = 0.0;  ///< of the border: where the surface beside the face is a step lower
};

/// The faces of a TIN; \a face_of: index of the face of each triangle, or -1.
std::vector<RoofFace> findFaces(const PatchSurface& surface, const RoofLineSettings& settings,
                                std::vector<std::int32_t>& face_of);

}  // namespace pcl_als::photogrammetry
