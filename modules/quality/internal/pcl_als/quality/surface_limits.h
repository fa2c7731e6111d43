// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als {

/// Criterion of surfaces that are compared.
struct SurfaceLimits : SurfaceCriterion {
  /// radians (10 degrees): limit of level ground for RMSDz
  double level_slope = 0.17453292519943295;
  double maximum_distance = 1.0;  ///< metres: larger differences are different objects
  /// places of a strip and area on level ground, and as many on slopes
  std::size_t candidates = 400;
};

}  // namespace pcl_als
