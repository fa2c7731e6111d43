// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/point_flag.h>
#include <pcl_als/quality/swath_point.h>

namespace pcl_als {

bool isCheckable(const SwathPoint& point) {
  const int code = point.classification;
  return code != 7 && code != 18 && (point.flags & kWithheld) == 0 && point.position.allFinite() &&
         std::isfinite(point.time);
}

bool isSolid(const SwathPoint& point) {
  const int code = point.classification;
  return isCheckable(point) && point.isLast() && (code < 3 || code > 5);
}

}  // namespace pcl_als
