// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/time_reference.h>
#include <pcl_als/io/time_scale.h>

#include "week_rollover.h"

namespace pcl_als {
namespace {

using Scale = TimeScale;

// Weeks of GPS time until 2056: a week beyond is none that points were measured in.
constexpr long kLastWeek = 4000;

double middle(const TimeRange& range) {
  return 0.5 * (range.first + range.last);
}

/// A way to bring the two together.
struct Candidate {
  Scale points, trajectory;
  double offset;
  std::optional<long> week;
};

Candidate candidate(Scale p, const TimeRange& points, Scale t, const TimeRange& trajectory,
                    std::optional<int> gps_week) {
  const double origins = gpsSecondsOffset(p, points.first) - gpsSecondsOffset(t, trajectory.first);
  if (p != Scale::week && t != Scale::week) return {p, t, origins, std::nullopt};
  const double apart = middle(trajectory) - middle(points) - origins;
  if (p == Scale::week && t == Scale::week) {
    const double weeks = std::clamp(std::round(apart / kSecondsPerWeek), -1.0, 1.0);
    return {p, t, weeks * kSecondsPerWeek, std::nullopt};
  }
  const double sign = p == Scale::week ? 1.0 : -1.0;
  const long week = gps_week ? *gps_week : std::lround(sign * apart / kSecondsPerWeek);
  return {p, t, origins + sign * static_cast<double>(week) * kSecondsPerWeek, week};
}

std::optional<Candidate> firstThatMeets(const TimeRange& points, TimeKind kind,
                                        const TimeRange& trajectory, std::optional<int> gps_week) {
  for (const Scale p : probableTimeScales(points, kind)) {
    for (const Scale t : probableTimeScales(trajectory)) {
      const Candidate next = candidate(p, points, t, trajectory, gps_week);
      if (next.week && (*next.week < 0 || *next.week > kLastWeek)) continue;
      if (points.last + next.offset >= trajectory.first &&
          points.first + next.offset <= trajectory.last) {
        return next;
      }
    }
  }
  return std::nullopt;
}

std::string rangesText(const std::string& name, const TimeRange& points,
                       const TimeRange& trajectory) {
  const auto describe = [](const TimeRange& times) {
    const std::string unix_time = unixTimeText(times);
    char text[80];
    std::snprintf(text, sizeof text, "%.3f to %.3f s", times.first, times.last);
    return text + (unix_time.empty() ? "" : " (" + unix_time.substr(0, unix_time.find(':')) + ")");
  };
  return name + ": its times, " + describe(points) + ", do not overlap the trajectory's, " +
         describe(trajectory);
}

void refuseUnusable(const std::string& name, const TimeRange& points, const TimeRange& trajectory) {
  if (trajectory.empty()) throw InputError(name + ": the trajectory has no times");
  if (points.empty()) throw InputError(name + ": has no point with a finite time");
  if (points.first == 0.0 && points.last == 0.0) {
    throw InputError(name + ": the time of every point is zero; GPS times are needed");
  }
}

/// Whole days that would bring times together which are both absolute or both of the week: seconds
/// of the day, or another GPS week.
std::string shiftText(const TimeRange& points, const TimeRange& trajectory) {
  constexpr double kDay = 86400.0;
  const double days = std::round((middle(trajectory) - middle(points)) / kDay);
  const double shift = days * kDay;
  if (days == 0.0 || std::abs(days) > 3660.0 || points.last + shift < trajectory.first ||
      points.first + shift > trajectory.last)
    return {};
  const long whole = std::lround(std::abs(days));
  const bool weeks = whole % 7 == 0;
  return "; they would overlap " + std::to_string(weeks ? whole / 7 : whole) +
         (weeks ? " week(s)" : " day(s)") + (days > 0.0 ? " later" : " earlier") +
         (weeks ? ": the GPS week of one of them is wrong"
                : ": give both in seconds of the week or in absolute times");
}

std::string remarkOf(const std::string& name, const Candidate& best) {
  if (best.offset == 0.0) return {};
  std::string text = name + ": times are " + timeScaleName(best.points) + ", the trajectory's " +
                     timeScaleName(best.trajectory);
  if (best.week) text += ", GPS week " + std::to_string(*best.week);
  char added[60];
  std::snprintf(added, sizeof added, ": %+.0f s", best.offset);
  return text + added;
}

}  // namespace

TimeAlignment reconcileTimes(const std::string& name, const TimeRange& points, TimeKind kind,
                             const TimeRange& trajectory, std::optional<int> gps_week) {
  refuseUnusable(name, points, trajectory);
  const std::optional<Candidate> best = firstThatMeets(points, kind, trajectory, gps_week);
  if (!best) {
    throw InputError(rangesText(name, points, trajectory) +
                     (gps_week ? " in GPS week " + std::to_string(*gps_week) : std::string()) +
                     shiftText(points, trajectory));
  }
  TimeAlignment alignment;
  alignment.offset = best->offset;
  if (best->points == Scale::week) {
    alignment.wrap_below = trajectory.first - 0.5 * kSecondsPerWeek;
    alignment.wrap_above = trajectory.last + 0.5 * kSecondsPerWeek;
  }
  alignment.remark = remarkOf(name, *best);
  return alignment;
}

TimeAlignment reconcileTimes(const PointFileInfo& file, const TimeRange& points,
                             const TimeRange& trajectory, std::optional<int> gps_week) {
  if (!file.time_fault.empty()) throw InputError(file.path.string() + ": " + file.time_fault);
  return reconcileTimes(file.path.string(), points, file.time_kind, trajectory, gps_week);
}

namespace detail {

void unwrapWeek(std::vector<TrajectorySample>& samples) {
  std::size_t crossings = 0, crossing = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (!isWeekRollover(samples[i - 1].time, samples[i].time)) continue;
    ++crossings;
    crossing = i;
  }
  if (crossings != 1) return;
  for (std::size_t i = crossing; i < samples.size(); ++i) samples[i].time += kSecondsPerWeek;
}

}  // namespace detail
}  // namespace pcl_als
