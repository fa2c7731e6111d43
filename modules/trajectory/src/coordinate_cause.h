// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <Eigen/Core>

#include <pcl_als/common/errors.h>

namespace pcl_als::detail {

/** \brief The likely reason for which a trajectory does not lie above its points: exchanged
 * columns, another unit, another zone.
 *
 * Each reason is tried on the mean positions; one under which the sensor is above its points, and
 * not further beside them than twice its height, is named: "with x and y exchanged". Empty where
 * none or several are.
 *
 * \param sensor, points mean positions at the same times, metres
 */
std::string coordinateCause(const Eigen::Vector3d& sensor, const Eigen::Vector3d& points);

/// The likely reason for which points lie ahead of (> 0) or behind where they were measured, by the
/// seconds that the sensor needs for the distance: UTC against GPS time. Empty for other times.
Warning timeCause(double seconds_ahead);

// Undulations of a geoid above the ellipsoid are -107 to 86 m (EGM2008); smaller offsets than 5 m
// have other causes as often.
inline constexpr double kLeastUndulation = 5.0, kLargestUndulation = 110.0;

}  // namespace pcl_als::detail
