// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "flown_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "random.h"
#include "trajectory_errors.h"

namespace pcl_als::simulation {

namespace {

/// A slow smooth motion: three sines of random period and phase, never beyond the amplitude.
class Sway {
 public:
  Sway(double amplitude, double shortest, double longest, Random& random) {
    constexpr std::array<double, 3> kShares = {0.5, 0.3, 0.2};
    for (std::size_t i = 0; i < 3; ++i)
      waves_[i] = {amplitude * kShares[i], 2.0 * kPi / random.uniform(shortest, longest),
                   random.uniform(0.0, 2.0 * kPi)};
  }
  double at(double t) const {
    double sum = 0.0;
    for (const Wave& w : waves_) sum += w.amplitude * std::sin(w.rate * t + w.phase);
    return sum;
  }
  double slopeAt(double t) const {
    double sum = 0.0;
    for (const Wave& w : waves_) sum += w.amplitude * w.rate * std::cos(w.rate * t + w.phase);
    return sum;
  }

 private:
  struct Wave {
    double amplitude, rate, phase;
  };
  std::array<Wave, 3> waves_{};
};

/// Motion of the aircraft along a line due to pilot and air.
class Motion {
 public:
  Motion(const PlannedLine& plan, const SimulationOptions& options, double wind)
      : Motion(plan, options, wind, Random(keyOf({options.seed, 0xF117, plan.id}))) {}

  /// \param t seconds since the first pulse
  Pose at(double t) const {
    const double along = speed_ * t + along_.at(t), aside = aside_.at(t);
    const Eigen::Vector2d right(course_.y(), -course_.x());
    const Eigen::Vector2d plan = start_ + along * course_ + aside * right;
    const Eigen::Vector2d velocity =
        (speed_ + along_.slopeAt(t)) * course_ + aside_.slopeAt(t) * right;
    Pose pose;
    pose.position = {plan.x(), plan.y(), height_ + up_.at(t)};
    pose.heading = std::atan2(velocity.x(), velocity.y());
    if (vertical_) return pose;
    pose.roll = roll_.at(t);
    pose.pitch = mean_pitch_ + pitch_.at(t);
    pose.heading += crab_ + yaw_.at(t);
    return pose;
  }

 private:
  Motion(const PlannedLine& plan, const SimulationOptions& options, double wind, Random random)
      : start_(plan.start),
        course_((plan.end - plan.start).normalized()),
        speed_(plan.speed),
        height_(plan.height),
        mean_pitch_(options.mean_pitch),
        vertical_(options.vertical),
        along_(2.0, 20.0, 60.0, random),
        aside_(3.0, 25.0, 70.0, random),
        up_(2.0, 20.0, 60.0, random),
        roll_(options.attitude_amplitude, 4.0, 18.0, random),
        pitch_(options.attitude_amplitude, 4.0, 18.0, random),
        yaw_(0.15 * options.largest_crab, 5.0, 20.0, random) {
    const double course = std::atan2(course_.x(), course_.y());
    crab_ = 0.85 * options.largest_crab * std::sin(course - wind);
  }

  Eigen::Vector2d start_, course_;
  double speed_, height_, mean_pitch_, crab_ = 0.0;
  bool vertical_;
  Sway along_, aside_, up_, roll_, pitch_, yaw_;
};

}  // namespace

FlownLine::FlownLine(const PlannedLine& plan, const SimulationOptions& options, double first_time,
                     double wind)
    : plan_(plan),
      pattern_(plan, options.scanner),
      first_time_(first_time),
      rate_(options.trajectory_rate) {
  const double duration = (plan.end - plan.start).norm() / plan.speed;
  const ErrorValues errors = options.errors.of(plan.session, plan.id, -1);
  offset_ = errors.offset();
  jump_ = errors.jump();
  const Motion motion(plan, options, wind);
  const auto samples = static_cast<std::size_t>(std::ceil((duration + 2.0 * kLead) * rate_)) + 1;
  true_.reserve(samples);
  for (std::size_t i = 0; i < samples; ++i)
    true_.push_back(motion.at(static_cast<double>(i) / rate_ - kLead));
  for (std::size_t i = 1; i < samples; ++i)  // continuous across north
    true_[i].heading +=
        2.0 * kPi * std::round((true_[i - 1].heading - true_[i].heading) / (2.0 * kPi));
  noisy_ = true_;
  if (options.noise.trajectory()) addErrors(options.noise, keyOf({options.seed, 0x6A55, plan.id}));
}

void FlownLine::addErrors(const NoiseOptions& noise, std::uint64_t key) {
  Random random(key);
  const ErrorTiming timing{1.0 / rate_, static_cast<double>(noisy_.size()) / rate_,
                           noise.correlation_time};
  std::array<std::unique_ptr<TrajectoryError>, 6> errors;
  const std::array<double, 6> sigma = {noise.position,   noise.position,   noise.position,
                                       noise.roll_pitch, noise.roll_pitch, noise.heading};
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors[i] = makeTrajectoryError(noise.process, sigma[i], timing, random);
  for (Pose& pose : noisy_) {
    for (int axis = 0; axis < 3; ++axis) pose.position[axis] += errors[axis]->next(random);
    pose.roll += errors[3]->next(random);
    pose.pitch += errors[4]->next(random);
    pose.heading += errors[5]->next(random);
  }
}

double FlownLine::lastTime() const {
  return first_time_ + static_cast<double>(true_.size() - 1) / rate_;
}

Pose FlownLine::interpolate(const std::vector<Pose>& table, double time) const {
  const double place = std::max(0.0, (time - first_time_) * rate_);
  const std::size_t before = std::min(static_cast<std::size_t>(place), table.size() - 2);
  const double share = place - static_cast<double>(before);
  const Pose &a = table[before], &b = table[before + 1];
  Pose pose;
  pose.position = a.position + share * (b.position - a.position);
  pose.roll = a.roll + share * (b.roll - a.roll);
  pose.pitch = a.pitch + share * (b.pitch - a.pitch);
  pose.heading = a.heading + share * (b.heading - a.heading);
  return pose;
}

Eigen::Vector3d FlownLine::shiftAt(double time) const {
  // From one sample to the next, as the trajectory is interpolated.
  const auto middle = static_cast<double>(true_.size() / 2);
  return offset_ + std::clamp((time - first_time_) * rate_ - middle, 0.0, 1.0) * jump_;
}

void FlownLine::append(const Eigen::Vector3d& origin, bool written,
                       std::vector<TrajectorySample>& samples) const {
  const std::vector<Pose>& table = written ? noisy_ : true_;
  for (std::size_t i = 0; i < table.size(); ++i) {
    TrajectorySample& sample = samples.emplace_back();
    sample.time = first_time_ + static_cast<double>(i) / rate_;
    sample.position = origin + table[i].position;
    if (written) sample.position += shiftAt(sample.time);
    sample.roll = table[i].roll;
    sample.pitch = table[i].pitch;
    sample.heading = table[i].heading - 2.0 * kPi * std::floor(table[i].heading / (2.0 * kPi));
  }
}

}  // namespace pcl_als::simulation
