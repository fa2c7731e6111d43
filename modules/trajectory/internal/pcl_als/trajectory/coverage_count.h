// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace pcl_als {

/** \brief Sizes of the corrections of many points, in constant memory.
 *
 * The correction of a point is in proportion to its range, so that those of a flight differ by a
 * small factor. Where position or attitude of the trajectory are wrong at some time, the range of
 * the points of that time is wrong as well, and their corrections exceed what biases can cause.
 */
class CorrectionSizes {
 public:
  /// A correction (metres) at a time of the trajectory; zero is not counted.
  void add(double x, double y, double z, double time);
  void merge(const CorrectionSizes& other);

  std::size_t count() const { return count_; }
  double largest() const;  ///< metres
  /// The size that nine tenths do not exceed, metres, up to a factor of 1.41; 0 without any.
  double typical() const;
  /// Why biases cannot have caused the largest correction, with its time; empty where they can.
  std::string objection() const;

 private:
  // Classes by the binary exponent of the squared size, from 1e-6 m to 4 km.
  static constexpr int kFirstExponent = -40;
  std::array<std::size_t, 64> classes_{};
  std::size_t count_ = 0;
  double largest_sq_ = 0.0, time_of_largest_ = 0.0;
};

class Trajectory;

/// Points without trajectory, by reason. Their effect is zero.
struct CoverageCount {
  std::size_t points = 0;  ///< all that were processed
  std::size_t before_start = 0, after_end = 0, in_gap = 0;
  std::size_t without_time = 0;      ///< time not finite
  std::size_t without_attitude = 0;  ///< no pitch and crab are known for their time
  std::size_t unsolved = 0;          ///< inverse only: no convergence to 1e-6 m
  /// Points whose time belongs to no strip with strip corrections, where these are used. They have
  /// the effect of the biases alone.
  std::size_t without_strip_errors = 0;
  /// Earliest and latest time among those of before_start, after_end, in_gap and without_attitude,
  /// seconds.
  double first_missed = std::numeric_limits<double>::infinity();
  double last_missed = -std::numeric_limits<double>::infinity();
  CorrectionSizes sizes;  ///< of the corrections of a SystemCorrection

  std::size_t missed() const {
    return before_start + after_end + in_gap + without_time + without_attitude;
  }
  /// Whether more than some points at the ends of flight lines have no strip corrections.
  bool lacksStripErrors() const { return without_strip_errors > points / 100; }
  void merge(const CoverageCount& other);
  /// "12 of 500 points have no trajectory: 10 before its start, 2 in gaps (their times …)"; for use
  /// in messages when missed() or unsolved is not zero.
  std::string describe(const Trajectory& trajectory) const;
};

}  // namespace pcl_als
