// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>

#include <pcl_als/radiometry/radiometric_model.h>

namespace pcl_als::detail {

/** \brief Ranges of points whose times are all in one span, and their factors for range and air.
 *
 * NaN and 1 for a point that is not below the sensor; returns how many there are. The exponential's
 * relative error is under 1.1e-11.
 */
std::uint64_t rangeKernel(const PathSpan& span, const RadiometricModel& model,
                          const PointColumns& points, std::size_t count, const RangeColumns& out);

}  // namespace pcl_als::detail
