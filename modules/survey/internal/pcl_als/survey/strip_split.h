// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <vector>

#include <pcl_als/common/excluded_points.h>
#include <pcl_als/survey/swath_track.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// A stretch of time between cuts, seconds: one flight line, or what lies between two.
struct TimeStretch {
  double from = 0.0, to = 0.0;              ///< times of its first and last point
  std::optional<ExclusionReason> excluded;  ///< in_turn or hovering; empty: a flight line
  bool isLine() const { return !excluded; }
};

/** \brief Divides points without strip numbers into flight lines.
 *
 * Cuts are made:
 * - where no point was measured for more than StripNaming::kLargestGap (20 s);
 * - in shorter gaps of more than a second, where the course changes by more than 30 degrees (60
 * without \a flight), or where the position after the gap is not ahead;
 * - on both sides of a turn: a change of course of more than 60 degrees in one direction at 1.5
 * degrees per second or more. Slower and smaller bends, as of corridors, are no turns;
 * - on both sides of hovering: a speed of less than 15 % (25 % without \a flight) of the speed at
 * or above which half of the way is flown between gaps of 20 s. It includes braking and starting,
 * below half of that speed in the 60 s before and after: a slow platform does not hover;
 * - around a passage: a stretch between turns or hovering that leads across from a line to the next
 * one, flown back in the opposite direction, with less than half the way of either. It is part of
 * the turn, as is a stretch of less than four seconds between turns or hovering.
 *
 * Speed and course are those over ground of \a flight where one is given, in the time system of \a
 * track, as means over a second. Otherwise they are those of the swath's centre, over 4, 8 or 16 s,
 * so that their standard deviation is small against the speed; the centre moves with roll and pitch
 * too, hence cuts are less certain by some seconds. The result depends on the track and the flight
 * alone, not on threads, the order of points, or the division into files.
 *
 * Not found are turns without a course (less than a second of points on a side of a gap) and, by
 * the points alone, hovering that is shorter than the window.
 */
std::vector<TimeStretch> splitTrack(const SwathTrack& track, const Trajectory* flight);

/** \brief Whether stretches of splitTrack() are certainly those of several flight lines, and not of
 * one line with gaps or bends.
 *
 * A line that follows another one leads back: its course differs by more than 135 degrees, or it
 * begins behind the end of the other. A line that continues behind a gap (a lake, the border of a
 * tile) or a bend does not, nor one that begins earlier than the platform can have turned back, in
 * a half circle at twice the acceleration of gravity: such returns are the fore and
 * aft half-scans of a conical scanner over a small area. Lines must hold at least half of the
 * points: where a platform mostly hovers or turns, what a line is cannot be told.
 */
bool leadBack(const SwathTrack& track, const std::vector<TimeStretch>& stretches);

}  // namespace pcl_als
