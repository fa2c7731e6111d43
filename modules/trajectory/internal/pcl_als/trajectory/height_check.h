// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/trajectory/line_sums.h>

namespace pcl_als {

/** \brief The height of a strip's trajectory above its points, from recorded scan angles.
 *
 * A point at the lateral distance x was measured at the angle atan(x / h) from the vertical. With a
 * trajectory too high by e, the angle from the trajectory has the tangent x / (h + e). The tangents
 * of recorded angles over those from the trajectory therefore have the slope (h + e) / h (least
 * squares with a constant, for the roll of the mount). No other property of the points shows a
 * constant error of height: the calibration absorbs it in lever_arm_x, lever_arm_y and range_bias.
 *
 * Recorded angles may be positive to either side, in the plane of the pulses or across the flight
 * line (which differ for scanners that look ahead); the interpretation with the better fit is used.
 * Strips whose angles deviate from those of the points by more than 0.6 degrees (mirror angles
 * without the roll of the flight, narrow parts of a swath) are not assessed.
 */
class HeightCheck {
 public:
  /// \a lateral, \a along, \a height: of a point from the sensor (right of flight, ahead of and
  /// below it), metres; \a scan_angle as recorded, radians.
  void add(double lateral, double along, double height, double scan_angle);

  bool judged() const;
  /// Ratio of tangents, recorded over those from the trajectory; 1 where the height is correct.
  double slope() const { return better().slope(); }
  double height() const { return across_.n > 0.0 ? height_sum_ / across_.n : 0.0; }  ///< m, mean
  /// Metres by which the trajectory is too high.
  double error() const { return height() * (1.0 - 1.0 / slope()); }

 private:
  /// Recorded tangents (y) over those from the trajectory (x).
  struct Line : LineSums {
    double slope() const;
    double residual() const;  ///< RMS of the tangents
    double spread() const;    ///< standard deviation of the recorded tangents
  };
  const Line& better() const;

  Line across_, in_plane_;
  double height_sum_ = 0.0;
};

/// Assessment of the heights of a trajectory from all strips together.
struct HeightError {
  enum class Kind {
    none,
    scale,   ///< recorded angles or heights wrong by one factor: not separable
    offset,  ///< heights wrong by the same number of metres at several flying heights
    gross,   ///< by more than a quarter, and not by two: no convention of angles explains it
  } kind = Kind::none;
  double metres = 0.0;  ///< metres by which the trajectory is too high
  double slope = 1.0;
  std::string text;         ///< the finding; empty for none
  bool undulation = false;  ///< whether the offset may be that of heights above a geoid
};
HeightError heightError(const std::vector<HeightCheck>& strips);

}  // namespace pcl_als
