// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/survey/swath_track.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// A stretch of time between cuts, seconds: one flight line, or a turn between two.
struct TimeStretch {
  double from = 0.0, to = 0.0;  ///< times of its first and last point
  bool turn = false;
};

/** \brief Divides points without strip numbers into flight lines.
 *
 * Cuts are made:
 * - where no point was measured for more than StripNaming::kLargestGap;
 * - in shorter gaps of more than a second, where the course changes, or where the position after
 * the gap is not ahead;
 * - on both sides of a turn: a change of course of more than 30 degrees at 1.5 degrees per second
 * or more. Points in turns are a stretch of their own.
 *
 * The course is that of \a flight where one is given, in the time system of \a track, else that of
 * the swath's centre over four seconds; the latter is less certain, and a turn must then be of 60
 * degrees. The result depends on the track alone, not on threads, the order of points, or the
 * division into files.
 *
 * Turns without a course are not found (less than a second of points on a side of a gap, a sensor
 * at rest): such lines stay together.
 */
std::vector<TimeStretch> splitTrack(const SwathTrack& track, const Trajectory* flight);

}  // namespace pcl_als
