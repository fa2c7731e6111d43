// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/local_frame.h>

namespace pcl_als {

LocalFrame LocalFrame::around(const Eigen::Vector3d& ground, std::string crs) {
  LocalFrame frame;
  for (int axis = 0; axis < 3; ++axis) frame.origin[axis] = 10.0 * std::round(ground[axis] / 10.0);
  frame.crs = std::move(crs);
  return frame;
}

}  // namespace pcl_als
