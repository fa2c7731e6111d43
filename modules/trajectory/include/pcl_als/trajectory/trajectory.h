// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
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

/** \brief A time-sorted flight trajectory with its gaps, and the local line fit of Habib et al.
 * 2011, section 2.1.
 *
 * At every sample a straight line is fitted (least squares in time) through the samples in [t - w,
 * t + w]; its plan direction gives kappa. Between samples, position and direction are interpolated
 * linearly. All is precomputed: a look-up costs an index and one interpolation. Memory: about 100
 * bytes per sample.
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
  /// Sorts by time and merges samples of equal time. Throws InputError for fewer than two distinct
  /// times, a time or position that is not finite, or a trajectory that does not move in plan;
  /// UsageError for impossible options.
  Trajectory(std::vector<TrajectorySample> samples, const Options& options);

  std::size_t size() const;
  double startTime() const;
  double endTime() const;
  const std::vector<Gap>& gaps() const;
  bool hasAttitude() const;
  /// One line for each kind of repair that was made (unsorted, duplicated); empty when the samples
  /// were clean.
  const std::vector<std::string>& repairs() const;

  Coverage coverage(double time) const;

  /// The line at a time; false (and \a line untouched) unless coverage(time) is covered. \a cursor
  /// is a hint that makes a look-up constant-time for times that come nearly in order: start with 0
  /// and pass the same variable on.
  bool lineAt(double time, FlightLine& line, std::size_t& cursor) const;
};

}  // namespace pcl_als
