// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Geometry>

namespace pcl_als {

/// Consecutive records of a file.
struct LasRecordRange {
  std::uint64_t first = 0, count = 0;
};

/// A part of a LAS file, in the unit of its coordinates.
struct LasWindow {
  std::optional<Eigen::AlignedBox2d> bounds;  ///< in plan, with its edges; default: everywhere
  /// Distance of points that suffices, of COPC files only; 0: all points.
  double resolution = 0.0;
};

}  // namespace pcl_als
