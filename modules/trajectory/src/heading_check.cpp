// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <numeric>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/heading_check.h>

namespace pcl_als {
namespace {

constexpr double kQuarter = 0.5 * kPi;
constexpr double kSlowest = 1.0;  // m/s: below it the course is that of the noise

/// Absolute angle between two directions, degrees.
double degreesBetween(double a, double b) {
  const double turns = (a - b) / (2.0 * kPi);
  return 360.0 * std::abs(turns - std::rint(turns));
}

}  // namespace

double headingFrom(HeadingReading reading, double value) {
  switch (reading) {
    case HeadingReading::heading:
      return value;
    case HeadingReading::from_east_counter_clockwise:
      return kQuarter - value;
    case HeadingReading::opposite:
      return value - kPi;
    case HeadingReading::from_north_counter_clockwise:
      return -value;
    case HeadingReading::left:
      return value + kQuarter;
    case HeadingReading::right:
      return value - kQuarter;
    case HeadingReading::radians_as_degrees:
      return value / kRadiansPerDegree;
    case HeadingReading::radians_from_east_as_degrees:
      return kQuarter - value / kRadiansPerDegree;
  }
  return value;
}

std::string_view describe(HeadingReading reading) {
  switch (reading) {
    case HeadingReading::heading:
      return "a heading clockwise from north";
    case HeadingReading::from_east_counter_clockwise:
      return "an angle counter-clockwise from east (90 degrees - heading)";
    case HeadingReading::opposite:
      return "the direction of the tail (heading + 180 degrees)";
    case HeadingReading::from_north_counter_clockwise:
      return "an angle counter-clockwise from north (minus the heading)";
    case HeadingReading::left:
      return "the direction to the left (heading - 90 degrees)";
    case HeadingReading::right:
      return "the direction to the right (heading + 90 degrees)";
    case HeadingReading::radians_as_degrees:
      return "in radians";
    case HeadingReading::radians_from_east_as_degrees:
      return "in radians, counter-clockwise from east";
  }
  return "";
}

void HeadingCheck::add(double course, double value) {
  for (std::size_t r = 0; r < kHeadingReadings; ++r) {
    const double away = degreesBetween(headingFrom(static_cast<HeadingReading>(r), value), course);
    ++histograms_[r][static_cast<std::size_t>(std::lround(away))];
  }
  lowest_ = count_ == 0 ? value : std::min(lowest_, value);
  highest_ = count_ == 0 ? value : std::max(highest_, value);
  ++count_;
}

void HeadingCheck::merge(const HeadingCheck& other) {
  if (other.count_ == 0) return;
  for (std::size_t r = 0; r < kHeadingReadings; ++r) {
    for (std::size_t i = 0; i < histograms_[r].size(); ++i) {
      histograms_[r][i] += other.histograms_[r][i];
    }
  }
  lowest_ = count_ == 0 ? other.lowest_ : std::min(lowest_, other.lowest_);
  highest_ = count_ == 0 ? other.highest_ : std::max(highest_, other.highest_);
  count_ += other.count_;
}

double HeadingCheck::deviation(HeadingReading reading) const {
  const auto& histogram = histograms_[static_cast<std::size_t>(reading)];
  std::size_t below = 0;
  for (std::size_t i = 0; i < histogram.size(); ++i) {
    below += histogram[i];
    if (4 * below >= 3 * count_) return static_cast<double>(i);
  }
  return 180.0;
}

double HeadingCheck::shareBeyondCrab(HeadingReading reading) const {
  if (count_ == 0) return 0.0;
  const auto& histogram = histograms_[static_cast<std::size_t>(reading)];
  const auto first = histogram.begin() + static_cast<std::ptrdiff_t>(kLargestCrab) + 1;
  return static_cast<double>(std::accumulate(first, histogram.end(), std::size_t{0})) /
         static_cast<double>(count_);
}

HeadingReading HeadingCheck::best() const {
  std::size_t best = 0;
  for (std::size_t r = 1; r < kHeadingReadings; ++r) {
    if (deviation(static_cast<HeadingReading>(r)) < deviation(static_cast<HeadingReading>(best))) {
      best = r;
    }
  }
  return static_cast<HeadingReading>(best);
}

HeadingCheck headingCheck(const std::vector<TrajectorySample>& samples) {
  HeadingCheck check;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const TrajectorySample &a = samples[i - 1], &b = samples[i];
    if (!std::isfinite(b.heading) || !(b.time > a.time)) continue;
    const Eigen::Vector2d step = (b.position - a.position).head<2>();
    if (!(step.norm() > kSlowest * (b.time - a.time))) continue;
    check.add(std::atan2(step.x(), step.y()), b.heading);
  }
  return check;
}

}  // namespace pcl_als
