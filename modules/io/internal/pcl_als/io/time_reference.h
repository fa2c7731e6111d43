// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <string>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/point_reader.h>

namespace pcl_als {

/// Adjusted standard GPS time (LAS, global encoding bit 0) = GPS seconds since 1980-01-06 - this.
inline constexpr double kAdjustedOffset = 1e9;

/** \brief Finds the time alignment of points and trajectory.
 *
 * Points count in seconds of the GPS week or in adjusted standard GPS time, as given by \a kind (a
 * file that states one and holds the other is recognised by its values); a trajectory in seconds of
 * the week, GPS seconds or adjusted standard time, which its values show. Where one side lacks the
 * week, it is \a gps_week, or the one that makes the ranges overlap.
 *
 * \param name the point file, for messages. InputError when there are no times (all zero), or
 * when nothing makes the ranges overlap: it gives both.
 */
TimeAlignment reconcileTimes(const std::string& name, const TimeRange& points, TimeKind kind,
                             const TimeRange& trajectory, std::optional<int> gps_week = {});
/// The same of a file. InputError also where its times are not used, with the reason.
TimeAlignment reconcileTimes(const PointFileInfo& file, const TimeRange& points,
                             const TimeRange& trajectory, std::optional<int> gps_week = {});

}  // namespace pcl_als
