// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string_view>
#include <vector>

namespace pcl_als {

/// Source of the sensor's attitude in the model of a calibration; also needed to apply its
/// biases.
enum class AttitudeSource {
  none,        ///< none: vertical, aligned with the flight line (quasi-rigorous)
  points,      ///< pitch and crab from the points (quasi-rigorous, AttitudeRecovery)
  trajectory,  ///< roll, pitch and heading of the trajectory (rigorous)
  nominal,     ///< level, heading along the course (rigorous, for scanners that are not linear)
};

std::string_view toString(AttitudeSource attitude);
/// "rigorous" where the attitude is the trajectory's or nominal, else "quasi_rigorous".
std::string_view modelName(AttitudeSource attitude);

/// Pitch (nose up) and crab (turn of the body against the line of flight, counter-clockwise), rad.
struct PitchAndCrab {
  double pitch = 0.0, crab = 0.0;
};

/** \brief Pitch and crab of the laser unit over time, as they were found from points.
 *
 * Linear in time between the knots of a pass (an uninterrupted piece of flight), constant for
 * kMaximumExtrapolation before its first and after its last knot. Times are those of the
 * trajectory, seconds. Memory: 24 bytes for each knot, ten knots per second of flight.
 */
class RecoveredAttitude {
 public:
  static constexpr double kMaximumExtrapolation = 2.0;  ///< seconds

  struct Knot {
    double time = 0.0;  ///< seconds
    PitchAndCrab angles;
  };
  using Pass = std::vector<Knot>;

  /// Adds a pass, after those that are there. InputError unless it has knots, their times increase
  /// and all values are finite.
  void addPass(Pass pass);
  /// Adds the passes of \a other for the times that no pass covers as yet.
  void addPasses(const RecoveredAttitude& other);

  bool empty() const { return passes_.empty(); }
  const std::vector<Pass>& passes() const { return passes_; }  ///< in order of their addition

  /// The pass that covers a time, the first that was added; null where none does.
  const Pass* passAt(double time) const;
  bool covers(double time) const { return passAt(time) != nullptr; }
  /// The angles at a time; where no pass covers it, those of the nearest knot in time; zero without
  /// any pass. Where several passes cover it, the first that was added counts.
  PitchAndCrab at(double time) const;

 private:
  std::vector<Pass> passes_;
};

}  // namespace pcl_als
