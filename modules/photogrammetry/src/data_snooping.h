// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include <pcl_als/adjustment/robust_weight.h>

#include "bundle_normal.h"
#include "bundle_problem.h"

namespace pcl_als::photogrammetry {

/// Residual of an observation against its standard deviation Q_vv = I - A Q A'.
struct TestValue {
  double standardised = 0.0;  ///< one-sided normal deviate of its probability, for rejection
  double size = 0.0;          ///< sqrt(v' Q_vv^-1 v / rank), about 1 without blunder
  double redundancy = 0.0;    ///< trace of Q_vv
};
TestValue testOf(const Observation& o, const Observation::Linear& linear,
                 const BundleNormal& normal);

/** \brief Data snooping (Baarda 1968): takes out of use what exceeds kRejectionLimit standard
 * deviations, at most the largest of each feature at a time, and a whole feature where its
 * observations cannot tell which of them is wrong.
 *
 * A control line whose four coordinates contradict the images is taken out with its measurements.
 */
class Snooping {
 public:
  /// Returns how many observations were taken out of use. \a limit: standard deviations.
  std::size_t reject(BundleProblem& problem, const BundleNormal& normal,
                     double limit = kRejectionLimit);
  void describe(const BundleProblem& problem, BundleResult& result) const;

 private:
  struct Rejected {
    std::size_t observation;
    double standardised;
    bool localised;
  };
  std::size_t rejectFarPoints(BundleProblem& problem, const BundleNormal& normal);

  std::vector<Rejected> rejected_;
};

}  // namespace pcl_als::photogrammetry
