// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/trajectory_reach.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

namespace pcl_als {

void requireReach(const std::vector<TimedPosition>& points, const LocalFrame& frame,
                  const std::shared_ptr<const Trajectory>& trajectory, const std::string& filter) {
  TrajectoryPlausibility plausibility(trajectory, TrajectoryPlausibility::Attitude::not_compared);
  const int strip = plausibility.addStrip("");
  for (const TimedPosition& point : points) plausibility.add(strip, point.time, point.position);
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
