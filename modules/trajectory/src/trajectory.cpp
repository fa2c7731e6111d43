// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/trajectory.h>
#include <pcl_als/trajectory/trajectory_screening.h>

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
  const bool given = static_cast<bool>(options.body_attitude);
  if (options.use_attitude + options.nominal_attitude + given > 1) {
    throw UsageError("trajectory: the attitude is that of the samples, nominal, or given");
  }
}

/// Unit vectors to the right of plan velocities; standing samples take the last (or, at the
/// beginning, the first) movement's. Returns how many stood still.
std::size_t rightDirections(std::vector<Eigen::Vector2d>& velocities, bool in_degrees) {
  const auto moves = [](const Eigen::Vector2d& v) { return v.norm() > kStandstill; };
  const auto moving = std::find_if(velocities.begin(), velocities.end(), moves);
  if (moving == velocities.end()) {
    throw InputError(std::string("trajectory: it does not move in plan; ") +
                     (in_degrees ? "its coordinates look like degrees: give those of a map, or "
                                   "columns called latitude and longitude"
                                 : "a flight direction is needed"));
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

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// Axis times angle of the turn from one rotation to another, in the body frame. A turn of more
/// than 90 degrees within one step has no direction between: none then.
Eigen::Vector3d turnBetween(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  Eigen::Quaterniond turn = from.conjugate() * to;
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const double sine = turn.vec().norm();  // of half the angle
  if (sine > std::sqrt(0.5)) return Eigen::Vector3d::Zero();
  const double stretch = sine < 1e-4 ? 2.0 : 2.0 * std::asin(sine) / sine;
  return stretch * turn.vec();
}

Eigen::Quaterniond turnBy(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn / angle));
}

Eigen::Quaterniond aboutVertical(double cosine, double sine) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(std::atan2(sine, cosine), Eigen::Vector3d::UnitZ()));
}

}  // namespace

Eigen::Quaterniond groundFromBody(double roll, double pitch, double heading) {
  return Eigen::AngleAxisd(-heading, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitY());
}

SensorPose FlightSpan::at(double time) const {
  const double elapsed = time - from;
  return {position + elapsed * velocity,
          rotation + elapsed * rotation_rate + (elapsed * elapsed) * rotation_curve, has_attitude,
          planes};
}

Trajectory::Trajectory(std::vector<TrajectorySample> samples, const Options& options)
    : half_width_(options.line_fit_half_width), planes_(options.scan_planes) {
  checkOptions(options);
  detail::refuseUnusable(samples);
  if (options.screen_samples) excludeOutliers(samples);
  detail::sortAndMerge(samples, repairs_);
  gap_threshold_ = detail::gapThreshold(samples, options.gap_threshold);
  detail::dropIsolated(samples, gap_threshold_, repairs_);
  if (samples.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("trajectory: more than 4 294 967 295 samples; split it");
  }
  samples_have_attitude_ = std::all_of(samples.begin(), samples.end(),
                                       [](const TrajectorySample& s) { return s.hasAttitude(); });
  findGaps(samples);
  fitDirections(samples);
  if (options.use_attitude) takeAttitude(samples);
  if (options.nominal_attitude) has_attitude_ = nominal_ = true;
  if (options.body_attitude) turnBody(options.body_attitude);
  buildIndex();
}

void Trajectory::excludeOutliers(std::vector<TrajectorySample>& samples) {
  const TrajectoryScreening screening = screenTrajectory(samples);
  const std::string objection = screening.objection();
  if (!objection.empty()) throw InputError("trajectory: " + objection);
  if (screening.outliers.empty()) return;
  repairs_.push_back("trajectory: " + screening.describe());
  removeAt(samples, screening.indices());
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
  const bool in_degrees = std::all_of(samples.begin(), samples.end(), [](const auto& sample) {
    return sample.position.template head<2>().cwiseAbs().maxCoeff() <= 360.0;
  });
  const std::size_t standing = rightDirections(directions, in_degrees);
  if (standing > 0) {
    repairs_.push_back("trajectory: the sensor stands still at " + std::to_string(standing) +
                       " sample(s): direction taken from the last movement");
  }
  nodes_.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    nodes_.push_back({samples[i].time, samples[i].position,
                      aboutVertical(directions[i].x(), directions[i].y())});
  }
}

void Trajectory::takeAttitude(const std::vector<TrajectorySample>& samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const TrajectorySample& sample = samples[i];
    if (!sample.hasAttitude()) {
      throw InputError("trajectory: no roll, pitch and heading at time " +
                       std::to_string(sample.time) + " s; the rigorous model needs them");
    }
    nodes_[i].rotation = groundFromBody(sample.roll, sample.pitch, sample.heading);
  }
  has_attitude_ = true;
}

void Trajectory::turnBody(const std::function<PitchAndCrab(double time)>& attitude) {
  has_attitude_ = true;
  for (Node& node : nodes_) {
    const PitchAndCrab a = attitude(node.time);
    node.rotation =
        node.rotation * Eigen::Quaterniond(Eigen::AngleAxisd(a.crab, Eigen::Vector3d::UnitZ()) *
                                           Eigen::AngleAxisd(a.pitch, Eigen::Vector3d::UnitX()));
  }
}

Trajectory Trajectory::withAttitude(
    const std::function<PitchAndCrab(double time)>& attitude) const {
  Trajectory turned = *this;
  turned.turnBody(attitude);
  return turned;
}

Trajectory Trajectory::rebuilt(Options options) const {
  std::vector<TrajectorySample> samples(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    samples[i].time = nodes_[i].time;
    samples[i].position = nodes_[i].position;
  }
  options.gap_threshold = gap_threshold_;
  options.screen_samples = false;
  return {std::move(samples), options};
}

Trajectory Trajectory::withoutAttitude() const {
  Options options;
  options.line_fit_half_width = half_width_;
  return rebuilt(std::move(options));
}

Trajectory Trajectory::withNominalAttitude() const {
  Options options;
  options.line_fit_half_width = half_width_;
  options.nominal_attitude = true;
  return rebuilt(std::move(options));
}

Trajectory Trajectory::withScanPlanes(ScanPlanes planes) const {
  Trajectory flight = *this;
  flight.planes_ = std::move(planes);
  return flight;
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

bool Trajectory::spanNode(double time, std::size_t& cursor, std::size_t& node) const {
  if (!(time >= startTime() && time <= endTime())) return false;
  cursor = locate(time, cursor);
  node = cursor;
  if (!isGap(node)) return true;
  // No sample is alone between gaps, so the last sample before one ends a span.
  if (time != nodes_[node].time) return false;
  --node;
  return true;
}

bool Trajectory::spanAt(double time, FlightSpan& span, std::size_t& cursor) const {
  std::size_t node = 0;
  if (!spanNode(time, cursor, node)) return false;
  const Node& a = nodes_[node];
  const Node& b = nodes_[node + 1];
  const double per_second = 1.0 / (b.time - a.time);
  span.from = a.time;
  span.to = b.time;
  span.position = a.position;
  span.velocity = (b.position - a.position) * per_second;
  // In equal parts with a turn small enough for FlightSpan; the last one ends exactly at the node.
  const Eigen::Vector3d turn = turnBetween(a.rotation, b.rotation);
  const double parts = std::max(1.0, std::ceil(turn.norm() / FlightSpan::kLargestTurn));
  const double part =
      std::clamp(std::floor((time - a.time) * per_second * parts), 0.0, parts - 1.0);
  const double step = (b.time - a.time) / parts;
  if (part > 0.0) {
    span.from = a.time + part * step;
    span.position += (part * step) * span.velocity;
  }
  if (part + 1.0 < parts) span.to = a.time + (part + 1.0) * step;
  const Eigen::Matrix3d rate = crossMatrix(turn * per_second);
  span.rotation = (a.rotation * turnBy((part / parts) * turn)).toRotationMatrix();
  span.rotation_rate = span.rotation * rate;
  span.rotation_curve = 0.5 * span.rotation_rate * rate;
  span.has_attitude = has_attitude_;
  span.planes = planes();
  return true;
}

bool Trajectory::pathAt(double time, PathSpan& span, std::size_t& cursor) const {
  std::size_t node = 0;
  if (!spanNode(time, cursor, node)) return false;
  const Node& a = nodes_[node];
  const Node& b = nodes_[node + 1];
  span = {a.time, b.time, a.position, (b.position - a.position) / (b.time - a.time)};
  return true;
}

bool Trajectory::poseAt(double time, SensorPose& pose, std::size_t& cursor) const {
  std::size_t node = 0;
  if (!spanNode(time, cursor, node)) return false;
  const Node& a = nodes_[node];
  const Node& b = nodes_[node + 1];
  const double cosine = a.rotation.dot(b.rotation);  // of half the turn
  constexpr double kSmallTurn = 1.0 - 0.125 * FlightSpan::kLargestTurn * FlightSpan::kLargestTurn;
  if (std::abs(cosine) < kSmallTurn) {
    FlightSpan span;
    spanAt(time, span, cursor);
    pose = span.at(time);
    return true;
  }
  // The same as the span's rotation to 1e-8, and cheaper.
  const double share = (time - a.time) / (b.time - a.time);
  Rotation mean;
  mean.coeffs() =
      (1.0 - share) * a.rotation.coeffs() + std::copysign(share, cosine) * b.rotation.coeffs();
  pose.position = a.position + share * (b.position - a.position);
  pose.rotation = mean.normalized().toRotationMatrix();
  pose.has_attitude = has_attitude_;
  pose.planes = planes();
  return true;
}

}  // namespace pcl_als
