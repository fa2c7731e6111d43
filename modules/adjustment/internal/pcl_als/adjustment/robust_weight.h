// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <limits>

namespace pcl_als {

/// Residuals up to this number of robust standard deviations have full weight (Huber 1964). For
/// normally distributed errors the efficiency is 96 %.
inline constexpr double kHuberLimit = 1.5;
/// Number of robust standard deviations beyond which observations are rejected: seven in a million
/// normally distributed errors.
inline constexpr double kRejectionLimit = 4.5;

/// Huber's weight of a residual: 1 up to the limit, then limit * scale / |residual|.
inline double huberWeight(double residual, double scale = 1.0, double limit = kHuberLimit) {
  const double size = std::abs(residual), full = limit * scale;
  return size <= full ? 1.0 : full / size;
}

/// Huber's weight, and none beyond a second limit. Both are numbers of standard deviations.
struct RobustWeight {
  double huber = kHuberLimit, rejection = kRejectionLimit;

  bool rejects(double residual, double scale = 1.0) const {
    return std::abs(residual) > rejection * scale;
  }
  double operator()(double residual, double scale = 1.0) const {
    return rejects(residual, scale) ? 0.0 : huberWeight(residual, scale, huber);
  }
};
inline constexpr double kNoRejection = std::numeric_limits<double>::infinity();

/// Huber's loss of a standardised residual: half its square up to the limit, then linear.
inline double huberLoss(double residual, double limit = kHuberLimit) {
  const double size = std::abs(residual);
  return size <= limit ? 0.5 * size * size : limit * size - 0.5 * limit * limit;
}

}  // namespace pcl_als
