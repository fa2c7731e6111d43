// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

namespace pcl_als::detail {

/// Two angles at one time.
struct MotionSample {
  double time = 0.0;        ///< seconds
  double x = 0.0, y = 0.0;  ///< radians
};

/** \brief Slope of one angle against another over time, with a realistic standard deviation.
 *
 * Changes over 0.4 to 2 seconds are compared by least squares, dy = a + b dx: constant offsets
 * (mounting angles) and slow trends (the edge of a tile that crosses the flight line) leave b
 * alone. Differences that overlap in time are not independent: a series counts as many observations
 * as there are such intervals in it. Series are combined with weights that allow for 0.05 of
 * systematic differences between them, and the standard deviation grows where they contradict each
 * other.
 */
class MotionSlope {
 public:
  /// A series in order of time. Series shorter than 1.6 seconds or without motion in y are ignored.
  void add(const std::vector<MotionSample>& series);

  bool known() const { return weight_ > 0.0; }
  double slope() const { return weight_ > 0.0 ? sum_ / weight_ : 0.0; }
  double std() const;
  /// Whether the slope lies above (below) a value by four of its standard deviations.
  bool above(double value) const { return known() && slope() - kSignificantStd * std() > value; }
  bool below(double value) const { return known() && slope() + kSignificantStd * std() < value; }
  /// RMS change of x in the series that count, radians.
  double motionX() const;

 private:
  static constexpr double kSignificantStd = 4.0;
  double weight_ = 0.0, sum_ = 0.0, sum_sq_ = 0.0;  ///< of the slopes
  double motion_ = 0.0;                             ///< of the squared changes of x
  std::size_t series_ = 0;
};

}  // namespace pcl_als::detail
