// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als::detail {

/** \brief Roll and pitch of a trajectory against what the points of a linear scanner show.
 *
 * Pitch: that of the pulses' plane; mounting angles are constant, so the means of a pass are taken
 * off both. Roll: moves the swath sideways unless the scanner is stabilised; compared by its
 * changes over a second, which the edges of a tile do not follow. A slope of -1 is a wrong sign,
 * one of 57 an angle in radians; without motion nothing is said.
 */
class AttitudeComparison {
 public:
  /// \a path: the same flight without attitude
  AttitudeComparison(const Trajectory& flight, const Trajectory& path)
      : flight_(flight), path_(path) {}

  /// What the points of a strip show, in order of time.
  void add(const std::vector<AttitudeRecovery::Instant>& instants);

  struct Result {
    bool wrong = false;
    std::string text;  ///< empty: nothing against the attitude
  };
  Result result() const;

 private:
  /// Line through y over x without constant.
  struct Line {
    double n = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    void add(double x, double y) { n += 1.0, xx += x * x, xy += x * y, yy += y * y; }
    double correlation() const;
    double slope() const { return xx > 0.0 ? xy / xx : 0.0; }
    double spreadX() const;
    double spreadY() const;
  };
  static Result judged(const Line& line, const char* angle);
  void addPass(const AttitudeRecovery::Instant* first, std::size_t count);

  const Trajectory& flight_;
  const Trajectory& path_;
  Line pitch_, roll_;
};

}  // namespace pcl_als::detail
