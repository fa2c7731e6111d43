// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_als/tin/tin.h>

#include "triangle_distance.h"

namespace pcl_als::tin {

/// The triangles a search has come to, in that order, without doubles. Small ones need no heap.
class TriangleSet {
 public:
  TriangleSet() { table_.fill(Tin::kNone); }
  bool insert(std::int32_t triangle);  ///< false if it was there already
  std::size_t size() const { return size_; }
  std::int32_t operator[](std::size_t i) const {
    return spilled_.empty() ? order_[i] : spilled_[i];
  }

 private:
  void spill();
  static std::size_t hash(std::int32_t triangle) {
    return static_cast<std::uint32_t>(triangle) * std::size_t{2654435769U};
  }

  static constexpr std::size_t kSmall = 32;
  std::array<std::int32_t, 2 * kSmall> table_;
  std::array<std::int32_t, kSmall> order_;
  std::vector<std::int32_t> spilled_table_, spilled_;
  std::size_t size_ = 0;
};

/// The triangle that is closest to a point in 3D and how far it is.
struct Closest {
  std::int32_t triangle = Tin::kNone;  ///< kNone when none is within the distance
  TriangleDistance distance;
  double others = 0.0;  ///< metres: all other triangles are at least so far away
};

/// Of equally close ones the lowest index. \a hint as for Tin::walk; it becomes the triangle under
/// the point. \a margin (metres): the others are looked at up to so much further than the closest.
Closest closestTriangle(const Tin& tin, const Eigen::Vector3d& point, double max_distance,
                        double margin, std::int32_t& hint);

}  // namespace pcl_als::tin
