// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include <pcl_als/io/time_reference.h>
#include <pcl_als/io/time_scale.h>

#include "leap_seconds.h"

namespace pcl_als {
namespace {

constexpr double kUnixOfGps = 315964800.0;  // Unix time of the start of GPS time, 1980-01-06
// Unix time of July 2017, GPS seconds of July 2027: values above are likelier Unix time.
constexpr double kLikelyUnix = 1.5e9;

/// Week seconds may run on past the end of the week, not much further.
bool looksLikeWeek(const TimeRange& range) {
  return range.first >= 0.0 && range.last <= 2.0 * kSecondsPerWeek;
}

}  // namespace

std::string timeScaleName(TimeScale scale) {
  switch (scale) {
    case TimeScale::week:
      return "seconds of the GPS week";
    case TimeScale::adjusted:
      return "adjusted standard GPS time";
    case TimeScale::gps:
      return "GPS seconds";
    case TimeScale::unix_time:
      return "Unix time";
  }
  return "";
}

/// As adjusted time, 1e9 s would be in 2043; as GPS seconds, less would be before September 2011,
/// when few wrote them.
std::vector<TimeScale> probableTimeScales(const TimeRange& range, TimeKind declared) {
  using S = TimeScale;
  if (range.last >= kLikelyUnix) return {S::unix_time, S::gps, S::adjusted};
  if (range.last >= kAdjustedOffset) return {S::gps, S::unix_time, S::adjusted};
  if (!looksLikeWeek(range)) return {S::adjusted, S::gps};
  if (declared == TimeKind::adjusted_standard) return {S::adjusted, S::week};
  return {S::week, S::adjusted};
}

double gpsSecondsOffset(TimeScale scale, double time) {
  if (scale == TimeScale::adjusted) return kAdjustedOffset;
  if (scale != TimeScale::unix_time) return 0.0;
  return detail::leapSecondsAt(time - kUnixOfGps) - kUnixOfGps;
}

std::string dateText(double gps_seconds) {
  constexpr double kLatest = 1e11;  // years of four digits
  if (!(std::abs(gps_seconds) < kLatest)) return "";
  const auto seconds = static_cast<std::time_t>(gps_seconds + kUnixOfGps);
  std::tm date{};
  char text[40] = "";
  if (gmtime_r(&seconds, &date) != nullptr) std::strftime(text, sizeof text, "%Y-%m-%d", &date);
  return text;
}

std::string unixTimeText(const TimeRange& seconds, double units_per_second) {
  if (seconds.empty() || probableTimeScales(seconds).front() != TimeScale::unix_time) return {};
  const double offset = gpsSecondsOffset(TimeScale::unix_time, seconds.first);
  const char* unit = units_per_second == 1e3   ? " in milliseconds"
                     : units_per_second == 1e6 ? " in microseconds"
                     : units_per_second == 1e9 ? " in nanoseconds"
                                               : "";
  char text[160];
  std::snprintf(text, sizeof text, "Unix time%s (%s): GPS time is Unix time - %.0f + %.0f s", unit,
                dateText(seconds.first + offset).c_str(), kUnixOfGps, offset + kUnixOfGps);
  return text;
}

std::optional<double> weekRollover(std::vector<TimeRange> observed) {
  // Between the lines of a flight there are minutes; other flights of the week are hours away.
  constexpr double kLongestTurn = 3600.0;
  if (observed.size() < 2) return std::nullopt;
  std::sort(observed.begin(), observed.end(),
            [](const TimeRange& a, const TimeRange& b) { return a.first < b.first; });
  double last = observed.front().last, longest = 0.0, rollover = 0.0;
  for (const TimeRange& range : observed) {
    if (range.first - last > longest) {
      longest = range.first - last;
      rollover = last + 0.5 * longest;
    }
    last = std::max(last, range.last);
  }
  const double first = observed.front().first;
  if (first < 0.0 || last > kSecondsPerWeek) return std::nullopt;
  if (first + kSecondsPerWeek - last > kLongestTurn || longest < 0.5 * kSecondsPerWeek)
    return std::nullopt;
  return rollover;
}

}  // namespace pcl_als
