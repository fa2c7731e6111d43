// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/point_file_info.h>
#include <pcl_als/common/time_alignment.h>

namespace pcl_als {

/// How seconds may be counted.
enum class TimeScale { week, adjusted, gps, unix_time };

/// "seconds of the GPS week"
std::string timeScaleName(TimeScale scale);

/// Scales that times may be in, the likeliest first, by their values and by what is declared.
std::vector<TimeScale> probableTimeScales(const TimeRange& range,
                                          TimeKind declared = TimeKind::none);

/// Seconds that are added to a time of an absolute scale to give GPS seconds; 0 for the week. In
/// Unix time the leap seconds of the date are added.
double gpsSecondsOffset(TimeScale scale, double time);

/// "2025-08-25", of GPS seconds
std::string dateText(double gps_seconds);

/// "Unix time (2025-08-25): GPS time is Unix time - 315964800 + 18 s", where times are probably
/// Unix time; empty otherwise. \a units_per_second: timeUnitsPerSecond() of the recorded values.
std::string unixTimeText(const TimeRange& seconds, double units_per_second = 1.0);

/// Where a flight passed the end of a GPS week: seconds of the week below this time are those of
/// the next week. \a observed: times at which points were measured, in any order. None where the
/// times are no seconds of the week, or where no line can have gone on through the end of the week.
std::optional<double> weekRollover(std::vector<TimeRange> observed);

}  // namespace pcl_als
