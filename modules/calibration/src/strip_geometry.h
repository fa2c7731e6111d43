// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/calibration/flight_plan.h>

namespace pcl_als {

/// Angle between two courses, radians, [0, pi].
double courseDifference(const StripGeometry& a, const StripGeometry& b);

/// Whether two lines have the same axis (within 20 degrees), in the same or the opposite direction.
bool sameWay(const StripGeometry& a, const StripGeometry& b);
bool opposite(const StripGeometry& a, const StripGeometry& b);

/// Distance of the middles of two lines across the first, metres.
double lateralSeparation(const StripGeometry& a, const StripGeometry& b);

/// Whether two lines' heights differ by no more than a tenth.
bool sameHeight(const StripGeometry& a, const StripGeometry& b);

}  // namespace pcl_als
