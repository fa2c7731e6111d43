// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>

namespace pcl_als {

/// The cubic B-spline with knots at whole numbers, centred on zero.
inline double cubicBSpline(double x) {
  const double u = std::abs(x);
  if (u >= 2.0) return 0.0;
  return u < 1.0 ? (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0 : std::pow(2.0 - u, 3) / 6.0;
}

constexpr double kMeanSquare = 151.0 / 315.0;  // integral of the square of the cubic B-spline

/// Variance of the smooth component of SharedErrors at a place between nodes, for coefficients of
/// variance one.
inline double smoothVariance(double place) {
  double sum = 0.0;
  const int first = static_cast<int>(std::floor(place)) - 1;
  for (int node = first; node < first + 4; ++node) {
    const double weight = cubicBSpline(place - node);
    sum += weight * weight;
  }
  return sum / kMeanSquare;
}

}  // namespace pcl_als
