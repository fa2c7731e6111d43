// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include <pcl_als/common/calibration_result.h>

#include "shared_errors.h"

namespace pcl_als {

/// Estimated error and standard deviation of a knot in one axis of kTrajectoryAxes; m or rad.
double errorOf(const TrajectoryErrorKnot& knot, std::size_t axis);
double stdOf(const TrajectoryErrorKnot& knot, std::size_t axis);

/// A curve of the strip corrections: index of the strip in its list, and axis.
using CorrectionCurve = std::pair<std::size_t, std::size_t>;

/// A part of a curve with errors that are larger than ordinary ones.
struct CorrectionExcursion {
  CorrectionCurve curve;
  double from = 0.0, to = 0.0;    ///< seconds; where the error falls to half of its peak
  double time = 0.0;              ///< of the peak, seconds
  double value = 0.0, std = 0.0;  ///< of the peak, metres or radians
  double ordinary = 0.0;          ///< standard deviation of an ordinary error, metres or radians
  double evidence = 0.0;          ///< peak over its limit, > 1
};

/** \brief What is ordinary in each axis, and the limits beyond which an error is not.
 *
 * An ordinary error has mean zero and the standard deviation s of the axis: the a priori one or, if
 * larger, that of the block. The latter is the robust standard deviation (1.4826 times the median
 * of the absolute values) of the estimates at the better determined half of the knots; the others
 * are near zero whatever the errors are. Its degrees of freedom are the sum over the strips of 1 +
 * duration / (a quarter of the correlation time, the distance of the nodes of the smooth
 * component). An estimate has a smaller variance than the error itself, so that it exceeds q s with
 * at most the probability of a normal variable (a priori standard deviation) or one of Student's t
 * (standard deviation of the block) beyond q. With a level of 1 % for all knots and axes of a block
 * together, q is the critical value for 0.01 / (knots x axes), both signs (Bonferroni).
 */
class OrdinaryErrors {
 public:
  /// \param apart curves of which it is known that their errors are not ordinary
  OrdinaryErrors(const std::vector<StripErrors>& strips, const SharedErrorModel& model,
                 const std::set<CorrectionCurve>& apart = {});

  double std(std::size_t axis) const { return std_[axis]; }
  double limit(std::size_t axis) const { return limit_[axis]; }
  /// Estimates over their own standard deviation beyond which they differ from zero.
  double significant() const { return significant_; }

 private:
  std::array<double, kTrajectoryAxes.size()> std_{}, limit_{};
  double significant_ = 0.0;
};

/** \brief The excursions of all curves.
 *
 * A run of knots of one sign beyond the limit, and beyond OrdinaryErrors::significant() of their
 * standard deviations, is one excursion. It reaches to where the error, linear between knots, falls
 * to half of its peak, or to the end of the curve. Knots more than 10 s apart are not neighbours.
 */
std::vector<CorrectionExcursion> findExcursions(const std::vector<StripErrors>& strips,
                                                const OrdinaryErrors& ordinary);

}  // namespace pcl_als
