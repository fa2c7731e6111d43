// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/survey/cloud_input.h>

namespace pcl_als {

void requireFineFloats(const PointFileInfo& cloud) {
  constexpr double kCoarsest = 0.002;  // metres
  const double step = cloud.resolution.maxCoeff();
  if (step <= kCoarsest) return;
  throw InputError(cloud.path.string() +
                   ": its coordinates are floats so far from the origin of its frame that they "
                   "have steps of " +
                   std::to_string(step) +
                   " m; subtract an origin near the points in double and give it as LocalFrame "
                   "(LocalFrame::around())");
}

}  // namespace pcl_als
