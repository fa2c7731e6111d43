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

/// Possible content of a column of headings (clockwise from grid north, radians after reading).
enum class HeadingReading {
  heading,                      ///< the heading
  from_east_counter_clockwise,  ///< 90 degrees - heading: a mathematical angle
  opposite,                     ///< heading + 180 degrees: the body's backward axis
  from_north_counter_clockwise,
  left,   ///< heading - 90 degrees: the axis to the left
  right,  ///< heading + 90 degrees: the axis to the right
  radians_as_degrees,
  radians_from_east_as_degrees,
};
constexpr std::size_t kHeadingReadings = 8;

/// The heading (radians) that a value means under this interpretation.
double headingFrom(HeadingReading reading, double value);
/// "an angle counter-clockwise from east (90 degrees - heading)"
std::string_view describe(HeadingReading reading);

/** \brief Compares headings with the course over ground, and finds the most likely interpretation
 * of values that do not follow the course.
 *
 * The heading of an aircraft differs from its course by the crab angle, seldom more than 20
 * degrees, so that three quarters of all differences are below kLargestCrab. For an angle with
 * another origin, sense or unit this holds along single courses only. Memory: 12 kB.
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
  /// Share of the values that differ from the course by more than kLargestCrab.
  double shareBeyondCrab(HeadingReading reading) const;
  bool followsCourse() const { return deviation(HeadingReading::heading) <= kLargestCrab; }
  /// The interpretation that agrees best with the course.
  HeadingReading best() const;
  /// Whether the value is constant.
  bool constant() const { return count_ > 0 && lowest_ == highest_; }
  double lowest() const { return lowest_; }  ///< radians

 private:
  std::array<std::array<std::uint32_t, 181>, kHeadingReadings> histograms_{};
  std::size_t count_ = 0;
  double lowest_ = 0.0, highest_ = 0.0;
};

/// The check of the samples of a trajectory at which the sensor moves; samples without a heading
/// are excluded.
HeadingCheck headingCheck(const std::vector<TrajectorySample>& samples);

}  // namespace pcl_als
