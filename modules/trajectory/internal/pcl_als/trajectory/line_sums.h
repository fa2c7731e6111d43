// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als {

/// Sums of the regression line of y over x with a constant.
struct LineSums {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(double at_x, double at_y) {
    n += 1.0, x += at_x, y += at_y;
    xx += at_x * at_x, xy += at_x * at_y, yy += at_y * at_y;
  }
  // About the means; n > 0.
  double sxx() const { return xx - x * x / n; }
  double sxy() const { return xy - x * y / n; }
  double syy() const { return yy - y * y / n; }
};

}  // namespace pcl_als
