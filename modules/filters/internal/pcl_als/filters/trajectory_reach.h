// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <pcl/point_cloud.h>

#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/point_fields.h>
#include <pcl_als/common/time_alignment.h>

namespace pcl_als {

class Trajectory;

/// A position in the ground frame (metres) and its time on the clock of the trajectory (seconds).
struct TimedPosition {
  double time = 0.0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// InputError that names \a filter where most of the points cannot have been measured from the
/// trajectory, as in a frame that was not set. \a frame: that of the cloud, for the message.
void requireReach(const std::vector<TimedPosition>& points, const LocalFrame& frame,
                  const std::shared_ptr<const Trajectory>& trajectory, const std::string& filter);

/// The same for points of a cloud at even intervals.
template <typename PointT>
void requireReach(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& points,
                  const LocalFrame& frame, const std::shared_ptr<const Trajectory>& trajectory,
                  const TimeAlignment& alignment, const std::string& filter) {
  constexpr std::size_t kSample = 1000;
  const std::size_t every = std::max<std::size_t>(1, points.size() / kSample);
  std::vector<TimedPosition> sample;
  for (std::size_t i = 0; i < points.size(); i += every) {
    const PointFields<PointT> point{cloud[static_cast<std::size_t>(points[i])]};
    sample.push_back({alignment(point.gpsTime()), frame.toGround(point.position())});
  }
  requireReach(sample, frame, trajectory, filter);
}

}  // namespace pcl_als
