// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <optional>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/strip_naming.h>
#include <pcl_als/survey/strip_split.h>

namespace pcl_als {
namespace {

using Bins = std::vector<SwathTrack::Bin>;
using Eigen::Vector2d;

constexpr double kGap = 1.0 + 1e-6;   // s: times may be whole seconds, which is no gap
constexpr double kHalfWindow = 2.0;   // s on either side from which a course is determined
constexpr double kLeastWindow = 1.0;  // s: shorter stretches have no course
constexpr double kLeastSpeed = 1.0;   // m/s: slower means at rest
constexpr double kLeastRate = 1.5 * kRadiansPerDegree;   // rad/s: half a standard-rate turn
constexpr double kTurn = 30.0 * kRadiansPerDegree;       // of the trajectory: a line has bends
constexpr double kSwathTurn = 60.0 * kRadiansPerDegree;  // of the swath's centre, less certain
constexpr double kLeastCertain = 0.15;  // rad, standard deviation of the swath's course
constexpr double kStep = 0.25;          // s between courses whose changes are added up over a gap

/// Angle from one direction to another, (-pi, pi].
double turned(const Vector2d& from, const Vector2d& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

/// Velocity of the swath's centre over bins [first, last); empty where it is uncertain.
std::optional<Vector2d> swathVelocity(const Bins& bins, std::size_t first, std::size_t last) {
  double n = 0.0, mean_time = 0.0;
  Vector2d mean = Vector2d::Zero();
  for (std::size_t i = first; i < last; ++i) {
    if (bins[i].placed == 0) continue;
    n += 1.0;
    mean_time += bins[i].middle() - bins[first].first;
    mean += bins[i].mean() - bins[first].mean();
  }
  if (n < 5.0 || bins[last - 1].last - bins[first].first < kLeastWindow) return std::nullopt;
  mean_time /= n;
  mean /= n;
  double tt = 0.0, squares = 0.0;
  Vector2d tx = Vector2d::Zero();
  for (std::size_t i = first; i < last; ++i) {
    if (bins[i].placed == 0) continue;
    const double t = bins[i].middle() - bins[first].first - mean_time;
    const Vector2d d = bins[i].mean() - bins[first].mean() - mean;
    tt += t * t;
    tx += t * d;
    squares += d.squaredNorm();
  }
  const Vector2d velocity = tx / tt;
  const double left = std::max(0.0, squares - velocity.squaredNorm() * tt) / (n - 2.0);
  const bool certain = std::sqrt(left / tt) < kLeastCertain * velocity.norm();
  if (!certain || velocity.norm() < kLeastSpeed) return std::nullopt;
  return velocity;
}

/// Courses of a track, by its trajectory or by the swath.
class Courses {
 public:
  Courses(const Bins& bins, const Trajectory* flight) : bins_(bins), flight_(flight) {}

  /// Velocity around a time within bins [first, last).
  std::optional<Vector2d> velocity(double time, std::size_t first, std::size_t last) const {
    return flight_ != nullptr ? flown(time) : swath(time, first, last);
  }
  double leastTurn() const { return flight_ != nullptr ? kTurn : kSwathTurn; }

  /// Change of course over a time span of the trajectory, all turns added up; 0 without one.
  double turnedBetween(double from, double to) const {
    double sum = 0.0;
    if (flight_ == nullptr) return sum;
    std::optional<Vector2d> last;
    for (double time = from; time <= to + 0.5 * kStep; time += kStep) {
      const auto now = flown(std::min(time, to));
      if (now && last) sum += turned(*last, *now);
      if (now) last = now;
      if (std::abs(sum) > kTurn) return std::abs(sum);
    }
    return std::abs(sum);
  }

 private:
  std::optional<Vector2d> flown(double time) const {
    constexpr double kHalf = 0.5;
    SensorPose before, after;
    std::size_t cursor = 0;
    const double start = std::max(time - kHalf, flight_->startTime());
    const double end = std::min(time + kHalf, flight_->endTime());
    if (!(start < end) || !flight_->poseAt(start, before, cursor) ||
        !flight_->poseAt(end, after, cursor)) {
      return std::nullopt;
    }
    const Vector2d velocity = (after.position - before.position).head<2>() / (end - start);
    if (velocity.norm() < kLeastSpeed) return std::nullopt;
    return velocity;
  }

  std::optional<Vector2d> swath(double time, std::size_t first, std::size_t last) const {
    const auto begin = bins_.begin();
    const auto earlier = [](const SwathTrack::Bin& bin, double t) { return bin.middle() < t; };
    const auto low =
        std::lower_bound(begin + static_cast<std::ptrdiff_t>(first),
                         begin + static_cast<std::ptrdiff_t>(last), time - kHalfWindow, earlier);
    const auto high = std::lower_bound(low, begin + static_cast<std::ptrdiff_t>(last),
                                       time + kHalfWindow, earlier);
    if (low == high) return std::nullopt;
    return swathVelocity(bins_, static_cast<std::size_t>(low - begin),
                         static_cast<std::size_t>(high - begin));
  }

  const Bins& bins_;
  const Trajectory* flight_;
};

/// Whether the points after the gap before bin \a at belong to another line.
bool cutsAt(const Bins& bins, std::size_t start, std::size_t at, const Courses& courses) {
  const double gap = bins[at].first - bins[at - 1].last;
  if (gap <= kGap) return false;
  if (gap > StripNaming::kLargestGap) return true;
  const double from = bins[at - 1].last, to = bins[at].first;
  if (courses.turnedBetween(from - kStep, to + kStep) > courses.leastTurn()) return true;
  std::size_t end = at + 1;
  while (end < bins.size() && bins[end].first - bins[end - 1].last <= kGap) ++end;
  const auto before = courses.velocity(from, start, at);
  const auto after = courses.velocity(to, at, end);
  if (before && after && std::abs(turned(*before, *after)) > courses.leastTurn()) return true;
  const Vector2d moved = bins[at].mean() - bins[at - 1].mean();
  return before && after && bins[at].placed > 0 && bins[at - 1].placed > 0 &&
         moved.norm() > before->norm() * gap && std::abs(turned(*before, moved)) > kSwathTurn;
}

/// Marks the bins of [first, last), which no gap parts, that were measured in a turn.
void markTurns(const Bins& bins, std::size_t first, std::size_t last, const Courses& courses,
               std::vector<bool>& turning) {
  std::vector<double> rate(last - first, 0.0);
  for (std::size_t i = first; i < last; ++i) {
    const double early = std::max(bins[i].middle() - kHalfWindow, bins[first].first);
    const double late = std::min(bins[i].middle() + kHalfWindow, bins[last - 1].last);
    if (!(late - early >= kLeastWindow)) continue;
    const auto before = courses.velocity(early, first, last);
    const auto after = courses.velocity(late, first, last);
    if (before && after) rate[i - first] = turned(*before, *after) / (late - early);
  }
  for (std::size_t i = first; i < last;) {
    const double sign = rate[i - first];
    std::size_t end = i + 1;
    if (std::abs(sign) < kLeastRate) {
      i = end;
      continue;
    }
    while (end < last && rate[end - first] * sign > 0.0 &&
           std::abs(rate[end - first]) >= kLeastRate) {
      ++end;
    }
    double change = 0.0;
    for (std::size_t k = i + 1; k < end; ++k)
      change += rate[k - first] * (bins[k].middle() - bins[k - 1].middle());
    if (std::abs(change) > courses.leastTurn())
      std::fill(turning.begin() + static_cast<std::ptrdiff_t>(i),
                turning.begin() + static_cast<std::ptrdiff_t>(end), true);
    i = end;
  }
}

}  // namespace

std::vector<TimeStretch> splitTrack(const SwathTrack& track, const Trajectory* flight) {
  Bins bins;
  bins.reserve(track.bins().size());
  for (const auto& entry : track.bins()) bins.push_back(entry.second);
  const Courses courses(bins, flight);
  std::vector<bool> turning(bins.size(), false);
  for (std::size_t first = 0, last = 0; first < bins.size(); first = last) {
    last = first + 1;
    while (last < bins.size() && bins[last].first - bins[last - 1].last <= kGap) ++last;
    markTurns(bins, first, last, courses, turning);
  }
  std::vector<TimeStretch> stretches;
  std::size_t start = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (i == 0 || turning[i] != turning[i - 1] || cutsAt(bins, start, i, courses)) {
      stretches.push_back({bins[i].first, bins[i].last, turning[i]});
      start = i;
    }
    stretches.back().to = std::max(stretches.back().to, bins[i].last);
  }
  return stretches;
}

}  // namespace pcl_als
