// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/common/strip.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als::detail {

/// A point as a return at an aligned time.
LidarReturn returnOf(const Strip<PointLidar>& strip, std::size_t row, double time);

/// Whether the points of a file can have been measured from the flight: warnings; InputError naming
/// the file where they cannot, unless \a force.
Warnings checkFlight(const LasFile& file, const TimeAlignment& alignment,
                     const std::shared_ptr<const Trajectory>& flight, bool force);
Warnings checkFlight(const std::string& name, const Strip<PointLidar>& strip,
                     const TimeAlignment& alignment,
                     const std::shared_ptr<const Trajectory>& flight, bool force);

}  // namespace pcl_als::detail
