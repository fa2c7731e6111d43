// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <cstdint>

namespace pcl_als::tin {

/// A plan position in units of the TIN's resolution; both coordinates in [0, kMaxExtent].
struct PlanPoint {
  std::int32_t x, y;
};

inline constexpr std::int32_t kMaxExtent = std::int32_t{1} << 24;

/// Twice the signed area of a, b, c: positive when they turn left. Exact: differences have 25 bits,
/// so the result has 51.
inline std::int64_t orientation(PlanPoint a, PlanPoint b, PlanPoint c) {
  const std::int64_t abx = b.x - a.x, aby = b.y - a.y, acx = c.x - a.x, acy = c.y - a.y;
  return abx * acy - aby * acx;
}

/// The part of inCircle() that double arithmetic cannot decide; see there.
bool inCircleExact(PlanPoint a, PlanPoint b, PlanPoint c, PlanPoint d);

/** \brief Whether d lies inside the circle through a, b, c (in counter-clockwise order). Exact.
 *
 * Four points on one circle are decided as if each point were lifted off the paraboloid x^2 + y^2
 * by an infinitesimal height, larger by orders for points that come later in the order (x, y). This
 * makes the Delaunay triangulation unique and a property of the positions alone: it does not depend
 * on input order, on the order of insertion or on points elsewhere. All four must be distinct.
 */
inline bool inCircle(PlanPoint a, PlanPoint b, PlanPoint c, PlanPoint d) {
  const double adx = a.x - d.x, ady = a.y - d.y, bdx = b.x - d.x, bdy = b.y - d.y;
  const double cdx = c.x - d.x, cdy = c.y - d.y;
  // Every factor below is an integer under 2^50 and so exact; only the three products and their sum
  // round.
  const double pa = (adx * adx + ady * ady) * (bdx * cdy - bdy * cdx);
  const double pb = (bdx * bdx + bdy * bdy) * (cdx * ady - cdy * adx);
  const double pc = (cdx * cdx + cdy * cdy) * (adx * bdy - ady * bdx);
  const double determinant = pa + pb + pc;
  // Three products and two sums err by less than 5 x 2^-53 of the sum of magnitudes; 8 is safe.
  const double bound = (std::abs(pa) + std::abs(pb) + std::abs(pc)) * 0x1p-50;
  if (determinant > bound) return true;
  if (determinant < -bound) return false;
  return inCircleExact(a, b, c, d);
}

}  // namespace pcl_als::tin
