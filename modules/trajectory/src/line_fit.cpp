// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "line_fit.h"

#include <algorithm>

namespace pcl_als::detail {
namespace {

/// Sums for the regression of plan position on time, relative to an origin near the samples.
class SlidingSums {
 public:
  void restart(const TrajectorySample& origin) {
    *this = SlidingSums();
    time_ = origin.time;
    position_ = origin.position.head<2>();
  }
  void add(const TrajectorySample& sample) { accumulate(sample, 1.0); }
  void remove(const TrajectorySample& sample) { accumulate(sample, -1.0); }

  Eigen::Vector2d slope() const { return (n_ * tp_ - t_ * p_) / (n_ * tt_ - t_ * t_); }

 private:
  void accumulate(const TrajectorySample& sample, double sign) {
    const double t = sample.time - time_;
    const Eigen::Vector2d p = sample.position.head<2>() - position_;
    n_ += sign;
    t_ += sign * t;
    tt_ += sign * t * t;
    p_ += sign * p;
    tp_ += (sign * t) * p;
  }

  double time_ = 0.0;
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
  double n_ = 0.0, t_ = 0.0, tt_ = 0.0;
  Eigen::Vector2d p_ = Eigen::Vector2d::Zero(), tp_ = Eigen::Vector2d::Zero();
};

/// The line through samples[low, high] for a window that slid too little to be worth keeping.
Eigen::Vector2d directSlope(const std::vector<TrajectorySample>& samples, std::size_t low,
                            std::size_t high) {
  SlidingSums sums;
  sums.restart(samples[low]);
  for (std::size_t i = low; i <= high; ++i) sums.add(samples[i]);
  return sums.slope();
}

}  // namespace

void fitVelocities(const std::vector<TrajectorySample>& samples, std::size_t first,
                   std::size_t last, double half_width, std::vector<Eigen::Vector2d>& velocities) {
  constexpr std::size_t kLeastSlide = 64;
  SlidingSums sums;
  std::size_t low = first, high = first;  // the window is [low, high)
  std::size_t restart_at = first;
  for (std::size_t i = first; i < last; ++i) {
    const double time = samples[i].time;
    while (samples[low].time < time - half_width) sums.remove(samples[low++]);
    while (high < last && samples[high].time <= time + half_width) sums.add(samples[high++]);
    if (i >= restart_at) {
      sums.restart(samples[i]);
      for (std::size_t k = low; k < high; ++k) sums.add(samples[k]);
      restart_at = i + std::max(kLeastSlide, high - low);
    }
    velocities[i] = high - low > 1
                        ? sums.slope()
                        : directSlope(samples, i > first ? i - 1 : i, std::min(i + 1, last - 1));
  }
}

}  // namespace pcl_als::detail
