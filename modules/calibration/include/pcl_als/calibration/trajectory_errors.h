// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/** \brief What the trajectory of a strip may be wrong by, shared by all its points for some time.
 *
 * Each of six errors (east, north, up; pitch, roll, heading about the flight line) is a stationary
 * Gauss-Markov process: standard deviation sigma, correlation exp(-|dt| / correlation_time). Strips
 * are independent. Defaults: post-processed survey-grade GNSS/INS.
 */
struct TrajectoryErrorModel {
  double position = 0.02;                       ///< metres, each axis
  double roll_pitch = 8.0 * kRadiansPerArcsec;  ///< radians
  double heading = 16.0 * kRadiansPerArcsec;    ///< radians
  double correlation_time = 30.0;               ///< seconds
  double knot_spacing =
      10.0;  ///< seconds, at most, between knots of the linear splines used for it

  void validate() const;  ///< UsageError naming a value that is not positive and finite
};

/// The knots of every strip's trajectory errors: six unknowns each, linear in time between knots.
class TrajectoryErrors {
 public:
  static constexpr int kPerKnot = 6;

  /// \param spans first and last firing time of every strip, seconds
  TrajectoryErrors(const std::vector<std::pair<double, double>>& spans,
                   const TrajectoryErrorModel& model);

  int knotCount() const { return knot_count_; }
  int unknowns() const { return knot_count_ * kPerKnot; }

  /// Where a time lies between two knots of its strip.
  struct Place {
    int knot = 0;       ///< the knot at or before the time, counted over all strips
    int next_knot = 0;  ///< the one after; the same for a strip with a single knot
    double next = 0.0;  ///< share of next_knot, 0 … 1
  };
  Place placeOf(int strip, double time) const;

  /// Information matrix of the prior, unknowns x unknowns, knot by knot (east north up pitch roll
  /// heading).
  Eigen::SparseMatrix<double> priorInformation() const;

 private:
  struct StripKnots {
    double start = 0.0, spacing = 1.0;
    int first = 0, count = 1;
  };
  std::vector<StripKnots> strips_;
  int knot_count_ = 0;
  TrajectoryErrorModel model_;
};

}  // namespace pcl_als
