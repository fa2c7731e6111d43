// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "track_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/statistics.h>
#include <pcl_als/io/strip_naming.h>

namespace pcl_als {
namespace {

using Eigen::Vector2d;

constexpr double kFlownHalfWindow = 0.5;  // s, of the velocity of a trajectory
// s, of that of the swath: some lines of a fast scan; the periods of roll and pitch and of slow
// scans, at the speed of a drone
constexpr double kHalfWindows[] = {2.0, 4.0, 8.0};
constexpr double kLeastWindow = 1.0;    // s: shorter stretches have no course
constexpr double kLeastCertain = 0.15;  // std of a velocity of the swath over its size (rad)
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double turned(const Vector2d& from, const Vector2d& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

TrackMotion::TrackMotion(const Bins& bins, const Trajectory* flight)
    : bins_(bins),
      flight_(flight),
      half_window_(flight != nullptr ? kFlownHalfWindow : kHalfWindows[0]),
      speeds_(bins.size(), kUnknown) {
  findSpans();
  if (flight_ != nullptr)
    measureFlown();
  else
    measureSwath();
}

void TrackMotion::findSpans() {
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const double gap =
        i == 0 ? std::numeric_limits<double>::infinity() : bins_[i].first - bins_[i - 1].last;
    if (gap > kGap) runs_.emplace_back(i, i);
    if (gap > StripNaming::kLargestGap) sessions_.emplace_back(i, i);
    runs_.back().second = sessions_.back().second = i + 1;
  }
}

void TrackMotion::measureFlown() {
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const auto velocity = flown(bins_[i].middle(), 0.0);
    if (velocity) speeds_[i] = velocity->norm();
  }
}

void TrackMotion::measureSwath() {
  for (const double half_window : kHalfWindows) {
    if (measureWindow(half_window) < kLeastCertain * typicalSpeed({0, bins_.size()})) return;
  }
}

/// Sets speeds from windows of this size; returns the median of their standard deviations.
double TrackMotion::measureWindow(double half_window) {
  half_window_ = half_window;
  std::vector<double> deviations;
  for (const Span& run : runs_) {
    for (std::size_t i = run.first; i < run.second; ++i) {
      const auto fit = swathAround(bins_[i].middle(), run);
      speeds_[i] = fit ? fit->velocity.norm() : kUnknown;
      if (fit) deviations.push_back(fit->std);
    }
  }
  return deviations.empty() ? 0.0 : medianInPlace(deviations);
}

double TrackMotion::typicalSpeed(const Span& span) const {
  std::vector<std::pair<double, double>> ways;  // speed, way
  double all = 0.0;
  for (std::size_t i = span.first; i < span.second; ++i) {
    if (!std::isfinite(speeds_[i])) continue;
    const double time = i > 0 ? std::min(bins_[i].middle() - bins_[i - 1].middle(), kGap) : 0.0;
    ways.emplace_back(speeds_[i], speeds_[i] * time);
    all += ways.back().second;
  }
  std::sort(ways.begin(), ways.end());
  double way = 0.0;
  for (const auto& [speed, part] : ways) {
    way += part;
    if (way >= 0.5 * all) return speed;
  }
  return 0.0;
}

/// Regression of the centres of the swath on time.
std::optional<TrackMotion::Fit> TrackMotion::swath(const Span& span) const {
  const auto [first, last] = span;
  double n = 0.0, mean_time = 0.0;
  Vector2d mean = Vector2d::Zero();
  for (std::size_t i = first; i < last; ++i) {
    if (bins_[i].placed == 0) continue;
    n += 1.0;
    mean_time += bins_[i].middle() - bins_[first].first;
    mean += bins_[i].mean() - bins_[first].mean();
  }
  if (n < 5.0 || bins_[last - 1].last - bins_[first].first < kLeastWindow) return std::nullopt;
  mean_time /= n;
  mean /= n;
  double tt = 0.0, squares = 0.0;
  Vector2d tx = Vector2d::Zero();
  for (std::size_t i = first; i < last; ++i) {
    if (bins_[i].placed == 0) continue;
    const double t = bins_[i].middle() - bins_[first].first - mean_time;
    const Vector2d d = bins_[i].mean() - bins_[first].mean() - mean;
    tt += t * t;
    tx += t * d;
    squares += d.squaredNorm();
  }
  const Vector2d velocity = tx / tt;
  const double left = std::max(0.0, squares - velocity.squaredNorm() * tt) / (n - 2.0);
  return Fit{velocity, std::sqrt(left / tt)};
}

std::optional<TrackMotion::Fit> TrackMotion::swathAround(double time, const Span& span) const {
  const auto begin = bins_.begin();
  const auto earlier = [](const SwathTrack::Bin& bin, double t) { return bin.middle() < t; };
  const auto end = begin + static_cast<std::ptrdiff_t>(span.second);
  const auto low = std::lower_bound(begin + static_cast<std::ptrdiff_t>(span.first), end,
                                    time - half_window_, earlier);
  const auto high = std::lower_bound(low, end, time + half_window_, earlier);
  if (low == high) return std::nullopt;
  return swath({static_cast<std::size_t>(low - begin), static_cast<std::size_t>(high - begin)});
}

std::optional<Vector2d> TrackMotion::flown(double time, double least) const {
  SensorPose before, after;
  std::size_t cursor = 0;
  const double start = std::max(time - kFlownHalfWindow, flight_->startTime());
  const double end = std::min(time + kFlownHalfWindow, flight_->endTime());
  if (!(start < end) || !flight_->poseAt(start, before, cursor) ||
      !flight_->poseAt(end, after, cursor)) {
    return std::nullopt;
  }
  const Vector2d velocity = (after.position - before.position).head<2>() / (end - start);
  if (velocity.norm() < least) return std::nullopt;
  return velocity;
}

std::optional<Vector2d> TrackMotion::velocity(double time, const Span& span, double least) const {
  if (isFlown()) return flown(time, least);
  const auto fit = swathAround(time, span);
  if (!fit || fit->std >= kLeastCertain * fit->velocity.norm() || fit->velocity.norm() < least)
    return std::nullopt;
  return fit->velocity;
}

Vector2d TrackMotion::moved(const Span& span) const {
  const double from = bins_[span.first].first, to = bins_[span.second - 1].last;
  if (isFlown()) {
    SensorPose first, last;
    std::size_t cursor = 0;
    if (!flight_->poseAt(from, first, cursor) || !flight_->poseAt(to, last, cursor))
      return Vector2d::Zero();
    return (last.position - first.position).head<2>();
  }
  const auto fit = swath(span);
  return fit ? Vector2d((to - from) * fit->velocity) : Vector2d(Vector2d::Zero());
}

}  // namespace pcl_als
