// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pcl_als::detail {

/// Squares of standard deviations as whole numbers, whose sums depend on no order.
constexpr double kSquareUnit = 1e-10;  // m^2: (0.01 mm)^2

inline std::uint64_t squareUnits(double metres) {
  constexpr double kLargest = 1000.0;  // metres
  const double size = std::min(metres, kLargest);
  return static_cast<std::uint64_t>(std::llround(size * size / kSquareUnit));
}
inline double rootMeanSquare(std::uint64_t units, std::uint64_t count) {
  return count == 0
             ? 0.0
             : std::sqrt(static_cast<double>(units) * kSquareUnit / static_cast<double>(count));
}

}  // namespace pcl_als::detail
