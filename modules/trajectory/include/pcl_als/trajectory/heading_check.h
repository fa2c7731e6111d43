// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// What a column that should be a heading (clockwise from grid north, radians after reading) may
/// hold instead.
enum class HeadingReading {
  heading,                      ///< as it should be
  from_east_counter_clockwise,  ///< 90 degrees - heading: a mathematical angle
  opposite,                     ///< heading + 180 degrees: the body's backward axis
  from_north_counter_clockwise,
  left,   ///< heading - 90 degrees: the axis to the left
  right,  ///< heading + 90 degrees: the axis to the right
  radians_as_degrees,
  radians_from_east_as_degrees,
};
constexpr std::size_t kHeadingReadings = 8;

/// The heading (radians) of a value that is read so.
double headingFrom(HeadingReading reading, double value);
/// "an angle counter-clockwise from east (90 degrees - heading)"
std::string_view describe(HeadingReading reading);

/** \brief Compares headings with the course over ground, and finds what a heading that does not
 * follow the course is instead.
 *
 * An aircraft's heading differs from its course by the crab angle, seldom more than 20 degrees, so
 * three quarters of all differences stay below kLargestCrab; an angle with another origin, sense or
 * unit does so only along single courses. Memory: 12 kB.
 */
class HeadingCheck {
 public:
  static constexpr double kLargestCrab = 30.0;  ///< degrees

  /// Course and value in radians; both finite.
  void add(double course, double value);
  void merge(const HeadingCheck& other);

  std::size_t count() const { return count_; }
  /// Upper quartile of the absolute difference to the course, degrees.
  double deviation(HeadingReading reading) const;
  bool followsCourse() const { return deviation(HeadingReading::heading) <= kLargestCrab; }
  /// The reading that follows the course best.
  HeadingReading best() const;
  /// Whether the value never changed.
  bool constant() const { return count_ > 0 && lowest_ == highest_; }
  double lowest() const { return lowest_; }  ///< radians

 private:
  std::array<std::array<std::uint32_t, 181>, kHeadingReadings> histograms_{};
  std::size_t count_ = 0;
  double lowest_ = 0.0, highest_ = 0.0;
};

/// The check over the samples of a trajectory that move; samples without a heading are left out.
HeadingCheck headingCheck(const std::vector<TrajectorySample>& samples);

}  // namespace pcl_als
