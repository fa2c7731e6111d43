// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/error_source.h>

#include "adjustment.h"
#include "shared_errors.h"

namespace pcl_als {

/** \brief Probability that the position of a trajectory jumps within a strip.
 *
 * The change d of a strip's position error between neighbouring knots has the prior N(0, p) of the
 * trajectory model. Where the adjustment gives it the mean m and the variance v, the observations
 * alone say (m / v) / l with a variance of 1 / l, l = 1/v - 1/p. A jump adds a normal variable to d
 * (standard deviation 0.1 m); the ratio of the likelihoods with and without it follows in closed
 * form. A block has a jump with a prior probability of 0.1, at each place and along each axis
 * alike. Where the changes scatter more than the model says (median absolute deviation), they count
 * as less certain.
 */
class JumpSearch {
 public:
  struct Strip {
    int index;
    std::string id;
  };
  /// \param solution of \a adjustment; \param strips one of each pass
  JumpSearch(const Adjustment& adjustment, const AdjustmentSolution& solution,
             const std::vector<Strip>& strips);

  /// The most probable jump.
  struct Place {
    std::string strip;
    std::size_t axis = 0;         ///< 0 east, 1 north, 2 up
    double from = 0.0, to = 0.0;  ///< seconds
    double value = 0.0;           ///< metres
  };
  /// None where the data determine none, or where it is improbable that there is one.
  const std::optional<Place>& place() const { return place_; }

  /// The probability of a jump anywhere, with place and size of the most probable one.
  const ErrorFinding& finding() const { return finding_; }

 private:
  ErrorFinding finding_;
  std::optional<Place> place_;
};

}  // namespace pcl_als
