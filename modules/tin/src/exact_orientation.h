// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>

namespace pcl_als::tin {

/// Sign of orientation() when double arithmetic is not sufficient: exact, by floating-point
/// expansions (Shewchuk, 1997).
double orientationExact(double ax, double ay, double bx, double by, double qx, double qy);

/// Positive when q is left of the directed line a-b, negative right of it, zero on it; the sign is
/// exact for doubles whose products neither overflow nor underflow.
inline double orientation(double ax, double ay, double bx, double by, double qx, double qy) {
  const double left = (ax - qx) * (by - qy), right = (ay - qy) * (bx - qx);
  const double determinant = left - right;
  // Differences, products and the last difference each err by half an ulp: (3 + 16u) u in all, u =
  // 2^-53; 4 u is safe.
  if (std::abs(determinant) > (std::abs(left) + std::abs(right)) * 0x1p-51) return determinant;
  return orientationExact(ax, ay, bx, by, qx, qy);
}

}  // namespace pcl_als::tin
