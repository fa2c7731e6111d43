// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "surface_texture.h"

#include <algorithm>
#include <cmath>

namespace pcl_als::detail {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

/// Sums for a plane z = a + b x + c y over some cells; x and y in cells from the middle one.
struct PlaneSums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, z = 0, xz = 0, yz = 0, zz = 0;

  void add(double u, double v, double w) {
    n += 1, x += u, y += v, xx += u * u, xy += u * v, yy += v * v;
    z += w, xz += u * w, yz += v * w, zz += w * w;
  }

  /// Gradient per cell and RMS of the residuals; false for places on a line.
  bool solve(double& gx, double& gy, double& rms) const {
    const double cxx = xx - x * x / n, cxy = xy - x * y / n, cyy = yy - y * y / n;
    const double cxz = xz - x * z / n, cyz = yz - y * z / n, czz = zz - z * z / n;
    const double determinant = cxx * cyy - cxy * cxy;
    if (!(determinant > 1e-9 * (cxx + cyy) * (cxx + cyy))) return false;
    gx = (cyy * cxz - cxy * cyz) / determinant;
    gy = (cxx * cyz - cxy * cxz) / determinant;
    rms = std::sqrt(std::max(0.0, czz - gx * cxz - gy * cyz) / n);
    return true;
  }
};

}  // namespace

void slopeAndRoughness(const RasterGrid& grid, const std::vector<float>& heights, int radius,
                       std::vector<float>& slope, std::vector<float>& roughness) {
  slope.assign(grid.cells(), RasterBand::kNoValue);
  roughness.assign(grid.cells(), RasterBand::kNoValue);
  const double least = 0.5 * (2 * radius + 1) * (2 * radius + 1);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t cell = grid.index(column, row);
      const float middle = heights[cell];
      if (std::isnan(middle)) continue;
      PlaneSums sums;
      for (int v = std::max(-radius, -row); v <= std::min(radius, grid.rows - 1 - row); ++v)
        for (int u = std::max(-radius, -column); u <= std::min(radius, grid.columns - 1 - column);
             ++u) {
          const float z = heights[grid.index(column + u, row + v)];
          if (!std::isnan(z)) sums.add(u, v, static_cast<double>(z) - static_cast<double>(middle));
        }
      double gx = 0.0, gy = 0.0, rms = 0.0;
      if (sums.n < least || !sums.solve(gx, gy, rms)) continue;
      slope[cell] =
          static_cast<float>(std::atan(std::hypot(gx, gy) / grid.cell) * kDegreesPerRadian);
      roughness[cell] = static_cast<float>(rms);
    }
  }
}

}  // namespace pcl_als::detail
