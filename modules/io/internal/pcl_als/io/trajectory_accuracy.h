// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/trajectory_io.h>

namespace pcl_als {

/// Writes standard deviations as an Applanix smrmsg file (readAccuracies()); unknown ones as zero.
/// The standard deviations of velocities are zero.
void writeAccuracies(const std::filesystem::path& path,
                     const std::vector<TrajectoryAccuracy>& accuracy);

/** \brief Reads standard deviations over time from an Applanix smrmsg file, or a RIEGL file (.poq).
 *
 * smrmsg: records of 10 little-endian doubles: time (s, as the SBET's), standard deviations of
 * north, east and down (m), of three velocities (m/s), of roll, pitch and heading (arc-minutes).
 * InputError names file and record for values that are negative, not finite or larger than 1 km or
 * 180 degrees, and for times that run backwards.
 */
std::vector<TrajectoryAccuracy> readAccuracies(const std::filesystem::path& path);

/// Standard deviations at a time, linear between records in order of time; NaN at times more than a
/// second from any record.
TrajectoryAccuracy accuracyAt(const std::vector<TrajectoryAccuracy>& accuracies, double time);

/// Root mean squares of standard deviations over some times.
struct AccuracySummary {
  std::size_t records = 0;                         ///< within the times
  double position = TrajectoryAccuracy::kUnknown;  ///< of one axis, metres; NaN where none is known
  double roll_pitch = TrajectoryAccuracy::kUnknown,
         heading = TrajectoryAccuracy::kUnknown;  ///< rad
};
/// Over the records within \a spans, or a second from them; without spans over all.
AccuracySummary summarize(const std::vector<TrajectoryAccuracy>& accuracies,
                          const std::vector<TimeRange>& spans = {});
/// "position 0.021 m, roll and pitch 9.0 arcsec, heading 21 arcsec"; unknown ones are omitted.
std::string describe(const AccuracySummary& summary);

}  // namespace pcl_als
