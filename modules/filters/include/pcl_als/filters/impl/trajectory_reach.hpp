// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <sstream>
#include <string>

#include <pcl/point_cloud.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/point_fields.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/common/time_unit.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

namespace pcl_als {

/// InputError where most of the points of a cloud cannot have been measured from the trajectory,
/// as in a frame that was not set: points at even intervals are looked at.
template <typename PointT>
void requireReach(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& points,
                  const LocalFrame& frame, const std::shared_ptr<const Trajectory>& trajectory,
                  const TimeAlignment& alignment, const std::string& filter) {
  constexpr std::size_t kSample = 1000;
  TrajectoryPlausibility plausibility(trajectory, TrajectoryPlausibility::Attitude::not_compared);
  const int strip = plausibility.addStrip("");
  const std::size_t every = std::max<std::size_t>(1, points.size() / kSample);
  for (std::size_t i = 0; i < points.size(); i += every) {
    const PointFields<PointT> point{cloud[static_cast<std::size_t>(points[i])]};
    plausibility.add(strip, alignment(secondsOfTime(point.gpsTime())),
                     frame.toGround(point.position()));
  }
  const std::string reason = plausibility.whyOutOfReach(strip);
  if (reason.empty()) return;
  std::ostringstream origin;
  origin.precision(9);
  origin << frame.origin.x() << ", " << frame.origin.y() << ", " << frame.origin.z() << " m";
  throw InputError(filter + ": the cloud cannot have been measured from the trajectory, " + reason +
                   ": call setLocalFrame with the frame of the cloud (its origin now is " +
                   origin.str() + "), or set the trajectory of this flight");
}

}  // namespace pcl_als
