// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// The local straight flight line at a time: what the quasi-rigorous model knows of the sensor at a
/// firing.
struct FlightLine {
  Eigen::Vector3d position;  ///< firing point: the interpolated trajectory, metres, ground frame
  double cos_kappa = 1.0;    ///< the flight direction on the ground is (-sin kappa, cos kappa)
  double sin_kappa = 0.0;
};

/// The trajectory between two neighbouring samples: position and direction are linear in time
/// there.
struct FlightSpan {
  double from = 0.0, to = 0.0;  ///< seconds, from < to
  Eigen::Vector3d position;     ///< at \a from, metres, ground frame
  Eigen::Vector3d velocity;     ///< metres per second
  Eigen::Vector2d right;        ///< (cos kappa, sin kappa) at \a from: the unit vector to the right
  Eigen::Vector2d right_rate;   ///< its change per second; at() makes the sum a unit vector again

  FlightLine at(double time) const;
};

/** \brief A time-sorted flight trajectory with its gaps, and the local line fit of Habib et al.
 * 2011, section 2.1.
 *
 * At every sample a straight line is fitted (least squares in time) through the samples in [t - w,
 * t + w] on its side of any gap; its plan direction gives kappa. Between samples, position and
 * direction are interpolated linearly. All is precomputed: a look-up costs an index and one
 * interpolation. Memory: about 100 bytes per sample while it is made, 52 afterwards.
 *
 * Fails (InputError) for what no line can be fitted to; what can be repaired is, and repairs() says
 * so. Where the sensor stands still (before take-off) the direction is that of the last movement.
 */
class Trajectory {
 public:
  struct Options {
    double line_fit_half_width =
        0.5;  ///< w, seconds, > 0; widened where it holds fewer than two samples
    double gap_threshold =
        0.0;  ///< seconds without a sample that are a gap; 0: max(1 s, 5 median steps)
  };
  enum class Coverage { covered, before_start, after_end, in_gap };
  struct Gap {
    double from, to;  ///< times of the samples on either side, seconds
  };

  explicit Trajectory(std::vector<TrajectorySample> samples)
      : Trajectory(std::move(samples), Options()) {}
  /// Sorts by time and merges samples of equal time (at most 1 m apart: their mean). Throws
  /// InputError for fewer than two distinct times, a time or position that is not finite, samples
  /// of one time that are further apart, or a trajectory that does not move in plan; UsageError for
  /// impossible options.
  Trajectory(std::vector<TrajectorySample> samples, const Options& options);

  std::size_t size() const { return nodes_.size(); }
  double startTime() const { return nodes_.front().time; }
  double endTime() const { return nodes_.back().time; }
  double lineFitHalfWidth() const { return half_width_; }  ///< seconds
  const std::vector<Gap>& gaps() const { return gaps_; }
  bool hasAttitude() const { return has_attitude_; }
  /// One line for each kind of repair that was made (unsorted, duplicated, alone between gaps,
  /// standing still); empty when the samples were clean.
  const std::vector<std::string>& repairs() const { return repairs_; }

  /// A time that is not finite counts as before the start (NaN, -inf) or after the end.
  Coverage coverage(double time) const;

  /// The line at a time; false (and \a line untouched) unless coverage(time) is covered. \a cursor
  /// is a hint that makes a look-up constant-time for times that come nearly in order: start with 0
  /// and pass the same variable on.
  bool lineAt(double time, FlightLine& line, std::size_t& cursor) const;

  /// As lineAt, but the whole span that holds the time, for callers with many points in it.
  bool spanAt(double time, FlightSpan& span, std::size_t& cursor) const;

 private:
  /// A sample with the direction of the line fitted around it.
  struct Node {
    double time;
    Eigen::Vector3d position;
    Eigen::Vector2d right;
  };

  void findGaps(const std::vector<TrajectorySample>& samples);
  void fitDirections(const std::vector<TrajectorySample>& samples);
  void buildIndex();
  std::size_t bucketOf(double time) const {
    return static_cast<std::size_t>((time - nodes_.front().time) * buckets_per_second_);
  }
  std::size_t locate(double time, std::size_t hint) const;
  bool isGap(std::size_t node) const {
    return nodes_[node + 1].time - nodes_[node].time > gap_threshold_;
  }

  std::vector<Node> nodes_;
  std::vector<Gap> gaps_;
  std::vector<std::string> repairs_;
  std::vector<std::uint32_t> buckets_;  ///< of equal duration: the first node at or after its start
  double buckets_per_second_ = 0.0;
  double gap_threshold_ = 0.0, half_width_ = 0.0;
  bool has_attitude_ = false;
};

}  // namespace pcl_als
