// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/survey/swath_track.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// Angle from one direction to another, (-pi, pi].
double turned(const Eigen::Vector2d& from, const Eigen::Vector2d& to);

/** \brief Speed and course of the sensor over ground at the times of a track: those of its
 * trajectory where one is known, else those of the centre of the swath.
 *
 * The centre of the swath moves with roll, pitch and the lines of the scan as well. Its velocity is
 * a regression over the shortest window of kHalfWindows after which its standard deviation is small
 * against the own speed of the track.
 */
class TrackMotion {
 public:
  using Bins = std::vector<SwathTrack::Bin>;
  using Span = std::pair<std::size_t, std::size_t>;  ///< bins [first, second)

  static constexpr double kGap = 1.0 + 1e-6;  ///< s: times may be whole seconds, which is no gap

  /// Both must exist as long as this object.
  TrackMotion(const Bins& bins, const Trajectory* flight);

  bool isFlown() const { return flight_ != nullptr; }  ///< by a trajectory
  /// Seconds on either side of a time from which its velocity is determined.
  double halfWindow() const { return half_window_; }
  /// Bins between gaps of more than kGap.
  const std::vector<Span>& runs() const { return runs_; }
  /// Bins between gaps of more than StripNaming::kLargestGap.
  const std::vector<Span>& sessions() const { return sessions_; }

  /// Metres per second at a bin; NaN where it is not known.
  double speed(std::size_t bin) const { return speeds_[bin]; }
  /// Distance-weighted median of the speed, metres per second; 0 where nothing moves.
  double typicalSpeed(const Span& span) const;
  /// Velocity around a time within a span; empty where its course is uncertain, or where the speed
  /// is not above \a least.
  std::optional<Eigen::Vector2d> velocity(double time, const Span& span, double least) const;
  /// As velocity(), of the trajectory at any time.
  std::optional<Eigen::Vector2d> flown(double time, double least) const;
  /// From the position at the first bin of a span to that at the last one, metres.
  Eigen::Vector2d moved(const Span& span) const;

 private:
  struct Fit {
    Eigen::Vector2d velocity;
    double std;  ///< m/s, of both components together
  };
  std::optional<Fit> swath(const Span& span) const;
  std::optional<Fit> swathAround(double time, const Span& span) const;
  void findSpans();
  void measureFlown();
  void measureSwath();
  double measureWindow(double half_window);

  const Bins& bins_;
  const Trajectory* flight_;
  double half_window_;
  std::vector<Span> runs_, sessions_;
  std::vector<double> speeds_;
};

}  // namespace pcl_als
