// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_als/processing/intensity_input.h>

namespace pcl_als {

/// Sorts single and last returns by strip; the map is asked when the strip changes.
class SurfacePoints {
 public:
  SurfacePoints(const StripAssignment& arrangement, IntensityWindow& window)
      : arrangement_(arrangement), window_(window) {}
  void add(const IntensityPoint& point) {
    if (!point.isLast()) return;
    const int strip = arrangement_.labels()[point.label].index;
    if (strip < 0) return;
    if (last_ == nullptr || strip_ != strip) {
      strip_ = strip;
      last_ = &window_.surface_points[strip];
    }
    last_->push_back(window_.relative(point.position));
  }

 private:
  const StripAssignment& arrangement_;
  IntensityWindow& window_;
  std::vector<Eigen::Vector3f>* last_ = nullptr;
  int strip_ = 0;
};

/// Label of the arrangement to which a point belongs.
inline std::uint32_t labelOf(StripAssignment::Assigner& sorter, const IntensityPoint& point) {
  return static_cast<std::uint32_t>(sorter.label(point.source, point.time));
}

}  // namespace pcl_als
