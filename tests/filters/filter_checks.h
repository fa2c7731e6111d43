// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <exception>
#include <limits>
#include <set>
#include <string>

#include <pcl/filters/filter.h>
#include <pcl/types.h>

#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/point_types.h>

namespace pcl_als::test {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A frame with its origin at height 0.
inline LocalFrame frameAt(double x, double y) {
  LocalFrame frame;
  frame.origin = {x, y, 0.0};
  return frame;
}

inline std::set<int> setOf(const pcl::Indices& indices) {
  return {indices.begin(), indices.end()};
}

/// What a filter complains of; empty where it does not.
inline std::string refusalOf(pcl::Filter<PointLidar>& filter) {
  pcl::PointCloud<PointLidar> filtered;
  try {
    filter.filter(filtered);
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace pcl_als::test
