// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/crs/crs.h>
#include <pcl_als/io/new_las_file.h>

namespace pcl_als {
namespace {

constexpr double kOffsetStep = 1000.0;
constexpr double kLastWeekSecond = 2.0 * 604800.0;

}  // namespace

LasWriterOptions newLasOptions(const std::string& crs, TimeKind time_kind,
                               const Eigen::Vector3d& minimum) {
  LasWriterOptions options;
  options.crs = crs;
  options.time_kind = time_kind == TimeKind::adjusted_standard ? TimeKind::adjusted_standard
                                                               : TimeKind::week_seconds;
  const Eigen::Vector3d metres = unitsOfCrs(crs).metres();
  for (int axis = 0; axis < 3; ++axis)
    options.offset[axis] = std::floor(minimum[axis] / metres[axis] / kOffsetStep) * kOffsetStep;
  return options;
}

TimeKind probableTimeKind(double earliest, double latest) {
  return earliest >= 0.0 && latest <= kLastWeekSecond ? TimeKind::week_seconds
                                                      : TimeKind::adjusted_standard;
}

}  // namespace pcl_als
