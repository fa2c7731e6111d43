// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <Eigen/Core>

#include <pcl_als/common/point_file_info.h>
#include <pcl_als/las/las_writer.h>

namespace pcl_als {

/// Options of a LAS 1.4 file of points that come from no LAS file: point format 6, steps of 0.001
/// in the unit of the CRS, offsets that are multiples of 1000 below \a minimum (metres).
LasWriterOptions newLasOptions(const std::string& crs, TimeKind time_kind,
                               const Eigen::Vector3d& minimum);

/// How times count whose source does not tell it: seconds of the week, which may run on for another
/// one, or adjusted standard GPS time, of which these values were in September 2011.
TimeKind probableTimeKind(double earliest, double latest);

}  // namespace pcl_als
