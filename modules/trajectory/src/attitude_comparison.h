// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/trajectory.h>

#include "motion_slope.h"

namespace pcl_als::detail {

/** \brief Compares roll and pitch of a trajectory with the attitude that the points indicate.
 *
 * Pitch: that of the pulses' plane (linear scanners). Roll shows in two ways, for any scanner: both
 * edges of the swath move sideways with it, unless the scanner is stabilised or the edge is one of
 * a tile; and recorded scan angles that are those of the mirror (without the roll, unlike the
 * definition of LAS) differ from the angle of the pulse from the vertical by it. Recorded angles
 * from the vertical contain no information about roll, and neither does a flight without changes of
 * roll. Each is compared by its changes within two seconds: a slope of 1 is right, -1 a wrong sign,
 * 57 an angle in radians, and 0 a stabilised scanner or an angle from the vertical.
 */
class AttitudeComparison {
 public:
  /// \a path: the same flight without attitude
  AttitudeComparison(const Trajectory& flight, const Trajectory& path)
      : flight_(flight), path_(path) {}

  /// Attitude from the points of a strip, in order of time.
  void add(const AttitudeRecovery::Outcome& outcome);

  struct Result {
    bool wrong = false;
    std::string text;  ///< empty: nothing against the attitude
  };
  Result result() const;

 private:
  /// Roll and pitch of a body over the local flight line.
  struct Angles {
    double roll = 0.0, pitch = 0.0;
  };
  /// Line through y over x without constant.
  struct Line {
    double n = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    void add(double x, double y) { n += 1.0, xx += x * x, xy += x * y, yy += y * y; }
    double correlation() const;
    double misfit() const;  ///< RMS of y - x
    double spreadX() const;
    double spreadY() const;
  };
  bool anglesAt(double time, Angles& angles);
  void addPitch(const AttitudeRecovery::Instant* first, std::size_t count);
  void addRoll(const AttitudeRecovery::Swath* first, std::size_t count);
  static Result judged(const MotionSlope& slope, const char* angle, const char* shown);
  Result withoutMotion() const;
  bool exchanged() const;

  const Trajectory& flight_;
  const Trajectory& path_;
  std::size_t cursor_ = 0, path_cursor_ = 0;
  Line pitch_level_, roll_level_;         ///< pitch of the points over both, about means
  MotionSlope pitch_, edges_, recorded_;  ///< y: shown by the points
  MotionSlope together_;                  ///< the right edge of the swath over the left one
  double largest_roll_ = 0.0;             ///< RMS over a pass about its mean, radians
};

}  // namespace pcl_als::detail
