// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <string>

#include <pcl_als/common/point_types.h>
#include <pcl_als/common/strip.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als::detail {

/// Conversion of the times of a file to those of the flight; InputError naming the file where there
/// is none.
TimeAlignment alignmentOf(const LasFile& file, const Trajectory& flight,
                          std::optional<int> gps_week);
TimeAlignment alignmentOf(const std::string& name, const Strip<PointLidar>& strip,
                          const Trajectory& flight, std::optional<int> gps_week);

}  // namespace pcl_als::detail
