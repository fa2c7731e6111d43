// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include "cairo_handles.h"

namespace pcl_als::detail {

/// A transparent image with dots: for millions of points, which a Canvas would keep one by one.
class DotLayer {
 public:
  DotLayer(int width, int height);
  /// \param at pixels from the upper left corner
  void add(const Eigen::Vector2d& at, double diameter, const Color& color);
  Image image() const { return imageOf(surface_.get()); }

 private:
  CairoSurface surface_;
  CairoContext context_;
};

}  // namespace pcl_als::detail
