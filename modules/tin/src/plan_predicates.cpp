// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "plan_predicates.h"

namespace pcl_als::tin {
namespace {

__extension__ using Int128 = __int128;

bool laterInOrder(PlanPoint a, PlanPoint b) {
  return a.x != b.x ? a.x > b.x : a.y > b.y;
}

/// The sign of the in-circle determinant. Its terms stay under 2^100.
int determinantSign(PlanPoint a, PlanPoint b, PlanPoint c, PlanPoint d) {
  const std::int64_t adx = a.x - d.x, ady = a.y - d.y, bdx = b.x - d.x, bdy = b.y - d.y;
  const std::int64_t cdx = c.x - d.x, cdy = c.y - d.y;
  const Int128 determinant = Int128{adx * adx + ady * ady} * (bdx * cdy - bdy * cdx) +
                             Int128{bdx * bdx + bdy * bdy} * (cdx * ady - cdy * adx) +
                             Int128{cdx * cdx + cdy * cdy} * (adx * bdy - ady * bdx);
  return determinant > 0 ? 1 : (determinant < 0 ? -1 : 0);
}

}  // namespace

bool inCircleExact(PlanPoint a, PlanPoint b, PlanPoint c, PlanPoint d) {
  const int sign = determinantSign(a, b, c, d);
  if (sign != 0) return sign > 0;
  // Lifting d takes it out of the circle. Lifting a raises the plane over d if d lies on a's side
  // of the line b-c, and so on. No three of four points on a circle are collinear: one step
  // decides.
  const bool b_leads = laterInOrder(b, a);
  const PlanPoint& ab = b_leads ? b : a;
  const bool c_leads = laterInOrder(c, ab);
  if (laterInOrder(d, c_leads ? c : ab)) return false;
  if (c_leads) return orientation(a, b, d) > 0;
  return b_leads ? orientation(a, d, c) > 0 : orientation(d, b, c) > 0;
}

}  // namespace pcl_als::tin
