// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <pcl_als/tin/tin.h>

namespace pcl_als::tin {

/// Normal of a triangle times twice its area; upward while the triangle is counter-clockwise in
/// plan.
Eigen::Vector3d areaNormal(const Tin& tin, std::int32_t triangle);

/// areaNormal() made unit and upward; straight up for a triangle without area.
Eigen::Vector3d unitNormal(const Tin& tin, std::int32_t triangle);

/// An areaNormal() made unit and upward.
Eigen::Vector3d unitUpward(const Eigen::Vector3d& area_normal);

/// Distance of a point from a triangle in 3D.
struct TriangleDistance {
  double distance_sq = 0.0;  ///< square metres
  bool inside = false;       ///< the point's projection along the normal falls inside
  Eigen::Vector3d weights;   ///< barycentric coordinates of the projection
  Eigen::Vector3d normal;    ///< areaNormal() of the triangle
};

/// The same bits for an edge or vertex whichever of its triangles is asked, so ties are ties.
TriangleDistance triangleDistance(const Tin& tin, std::int32_t triangle,
                                  const Eigen::Vector3d& point);

/// Whether a plan position is within a distance of the plan segment a-b.
inline bool segmentWithin(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& point, double distance_sq) {
  const double bx = b.x() - a.x(), by = b.y() - a.y();
  const double px = point.x() - a.x(), py = point.y() - a.y();
  const double along = px * bx + py * by, length_sq = bx * bx + by * by;
  if (along <= 0.0) return px * px + py * py <= distance_sq;
  if (along >= length_sq) {
    const double qx = point.x() - b.x(), qy = point.y() - b.y();
    return qx * qx + qy * qy <= distance_sq;
  }
  const double across = bx * py - by * px;
  return across * across <= distance_sq * length_sq;
}

}  // namespace pcl_als::tin
