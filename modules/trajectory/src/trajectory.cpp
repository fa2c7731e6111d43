// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/trajectory.h>

#include "line_fit.h"
#include "sample_repair.h"

namespace pcl_als {
namespace {

/// Plan speed (m/s) below which the sensor stands still and a direction would be noise.
constexpr double kStandstill = 0.01;

void checkOptions(const Trajectory::Options& options) {
  if (!std::isfinite(options.line_fit_half_width) || options.line_fit_half_width <= 0.0) {
    throw UsageError("trajectory: line_fit_half_width must be a positive number of seconds, not " +
                     std::to_string(options.line_fit_half_width));
  }
  if (!std::isfinite(options.gap_threshold) || options.gap_threshold < 0.0) {
    throw UsageError("trajectory: gap_threshold must be 0 or a positive number of seconds, not " +
                     std::to_string(options.gap_threshold));
  }
}

/// Unit vectors to the right of plan velocities; standing samples take the last (or, at the
/// beginning, the first) movement's. Returns how many stood still.
std::size_t rightDirections(std::vector<Eigen::Vector2d>& velocities) {
  const auto moves = [](const Eigen::Vector2d& v) { return v.norm() > kStandstill; };
  const auto moving = std::find_if(velocities.begin(), velocities.end(), moves);
  if (moving == velocities.end()) {
    throw InputError("trajectory: it does not move in plan; a flight direction is needed");
  }
  Eigen::Vector2d right(moving->y(), -moving->x());
  std::size_t standing = 0;
  for (Eigen::Vector2d& velocity : velocities) {
    if (moves(velocity)) {
      right = Eigen::Vector2d(velocity.y(), -velocity.x());
    } else {
      ++standing;
    }
    velocity = right.normalized();
  }
  return standing;
}

}  // namespace

FlightLine FlightSpan::at(double time) const {
  const double elapsed = time - from;
  const Eigen::Vector2d direction = right + elapsed * right_rate;
  const double scale = 1.0 / direction.norm();
  return {position + elapsed * velocity, scale * direction.x(), scale * direction.y()};
}

Trajectory::Trajectory(std::vector<TrajectorySample> samples, const Options& options)
    : half_width_(options.line_fit_half_width) {
  checkOptions(options);
  detail::sortAndMerge(samples, repairs_);
  gap_threshold_ = detail::gapThreshold(samples, options.gap_threshold);
  detail::dropIsolated(samples, gap_threshold_, repairs_);
  if (samples.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("trajectory: more than 4 294 967 295 samples; split it");
  }
  has_attitude_ = std::all_of(samples.begin(), samples.end(),
                              [](const TrajectorySample& s) { return s.hasAttitude(); });
  findGaps(samples);
  fitDirections(samples);
  buildIndex();
}

void Trajectory::findGaps(const std::vector<TrajectorySample>& samples) {
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Gap step{samples[i - 1].time, samples[i].time};
    if (step.to - step.from > gap_threshold_) gaps_.push_back(step);
  }
}

void Trajectory::fitDirections(const std::vector<TrajectorySample>& samples) {
  std::vector<Eigen::Vector2d> directions(samples.size());
  std::size_t first = 0;
  for (std::size_t last = 1; last <= samples.size(); ++last) {
    if (last < samples.size() && samples[last].time - samples[last - 1].time <= gap_threshold_)
      continue;
    detail::fitVelocities(samples, first, last, half_width_, directions);
    first = last;
  }
  const std::size_t standing = rightDirections(directions);
  if (standing > 0) {
    repairs_.push_back("trajectory: the sensor stands still at " + std::to_string(standing) +
                       " sample(s): direction taken from the last movement");
  }
  nodes_.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    nodes_.push_back({samples[i].time, samples[i].position, directions[i]});
  }
}

void Trajectory::buildIndex() {
  const std::size_t count = nodes_.size();
  // A duration too short for its reciprocal gets one bucket.
  buckets_per_second_ = static_cast<double>(count) / std::max(endTime() - startTime(), 1e-9);
  buckets_.resize(bucketOf(endTime()) + 2, static_cast<std::uint32_t>(count));
  for (std::size_t node = count; node-- > 0;) {
    buckets_[bucketOf(nodes_[node].time)] = static_cast<std::uint32_t>(node);
  }
  for (std::size_t bucket = buckets_.size() - 1; bucket-- > 0;) {
    buckets_[bucket] = std::min(buckets_[bucket], buckets_[bucket + 1]);
  }
}

std::size_t Trajectory::locate(double time, std::size_t hint) const {
  const std::size_t last_span = nodes_.size() - 2;
  for (std::size_t span = hint; span <= std::min(hint + 1, last_span); ++span) {
    if (nodes_[span].time <= time && time < nodes_[span + 1].time) return span;
  }
  const std::size_t bucket = bucketOf(time);
  const auto after =
      std::upper_bound(nodes_.begin() + buckets_[bucket], nodes_.begin() + buckets_[bucket + 1],
                       time, [](double value, const Node& node) { return value < node.time; });
  return std::min(static_cast<std::size_t>(after - nodes_.begin()) - 1, last_span);
}

Trajectory::Coverage Trajectory::coverage(double time) const {
  if (!(time >= startTime())) return Coverage::before_start;
  if (time > endTime()) return Coverage::after_end;
  const std::size_t span = locate(time, 0);
  return isGap(span) && time > nodes_[span].time && time < nodes_[span + 1].time
             ? Coverage::in_gap
             : Coverage::covered;
}

bool Trajectory::spanAt(double time, FlightSpan& span, std::size_t& cursor) const {
  if (!(time >= startTime() && time <= endTime())) return false;
  cursor = locate(time, cursor);
  std::size_t node = cursor;
  if (isGap(node)) {
    // No sample is alone between gaps, so the last sample before one ends a span.
    if (time != nodes_[node].time) return false;
    --node;
  }
  const Node& a = nodes_[node];
  const Node& b = nodes_[node + 1];
  const double per_second = 1.0 / (b.time - a.time);
  span.from = a.time;
  span.to = b.time;
  span.position = a.position;
  span.velocity = (b.position - a.position) * per_second;
  span.right = a.right;
  // A turn of more than 90 degrees within one step has no direction between: keep the first.
  const bool turns_back = a.right.dot(b.right) <= 0.0;
  span.right_rate = turns_back ? Eigen::Vector2d(0.0, 0.0) : (b.right - a.right) * per_second;
  return true;
}

bool Trajectory::lineAt(double time, FlightLine& line, std::size_t& cursor) const {
  FlightSpan span;
  if (!spanAt(time, span, cursor)) return false;
  line = span.at(time);
  return true;
}

}  // namespace pcl_als
