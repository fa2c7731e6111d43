// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/survey_types.h>

namespace pcl_als::benchmark {

/** \brief Two published methods to find a flight path from points, implemented from their
 * descriptions, for comparison.
 */

/// Roussel, Bourdon and Achim 2020 (track_sensor of lidR): the point nearest to the rays through
/// first and last returns of half a second, weighted by the separation of the returns; one pulse
/// per millisecond, at least 50 pulses. Points in order of time.
std::vector<TrajectorySample> intersectionOfRays(const std::vector<LidarReturn>& points);

/// The method of PDAL's filters.trajectory (after Gatziolis and McGaughey 2019): a piecewise cubic
/// polynomial with blocks of one second, continuous to the second derivative, by robust least
/// squares of rays through several returns and of recorded scan angles, one pulse of each kind per
/// millisecond, with small weights for accelerations. Samples at multiples of \a step
/// seconds.
std::vector<TrajectorySample> splineOfRaysAndAngles(const std::vector<LidarReturn>& points,
                                                    double step);

}  // namespace pcl_als::benchmark
