// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <pcl_als/tin/tin.h>

namespace pcl_als::test {

__extension__ using Int128 = __int128;

struct LatticePoint {
  std::int64_t x, y;
  bool operator<(const LatticePoint& o) const { return x != o.x ? x < o.x : y < o.y; }
  bool operator==(const LatticePoint& o) const { return x == o.x && y == o.y; }
};

/// Points on whole millimetres at z = 0.
std::vector<Eigen::Vector3d> pointsAt(const std::vector<LatticePoint>& lattice);
/// The TIN's points in steps of its resolution.
std::vector<LatticePoint> latticeOf(const Tin& tin);

/// Sign of the in-circle determinant of a, b, c (counter-clockwise) and d: positive inside.
int inCircleSign(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d);
Int128 doubledArea(LatticePoint a, LatticePoint b, LatticePoint c);

/** \brief What is wrong with a TIN as the Delaunay triangulation of its points; empty if nothing
 * is.
 *
 * By exact integer arithmetic of its own: every triangle counter-clockwise; neighbours mutual, each
 * directed edge once; every distinct position used by the first point on it; Euler's formula; areas
 * that add up to that of the convex hull; every edge locally Delaunay, and where four points lie on
 * a circle the last of them in the order (x, y) not on the diagonal.
 */
std::string verify(const Tin& tin);

using PlanTriangle = std::array<LatticePoint, 3>;
/// The triangle's corners from the lowest one on: equal for equal triangles of different TINs.
PlanTriangle planTriangle(const std::vector<LatticePoint>& lattice, const Tin::Triangle& triangle);
std::set<PlanTriangle> planTriangles(const Tin& tin);

}  // namespace pcl_als::test
