// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>

#include <pcl_als/simulation/error_process.h>

#include "random.h"

namespace pcl_als::simulation {

/// One component of a trajectory's errors, sample by sample.
class TrajectoryError {
 public:
  virtual ~TrajectoryError() = default;
  virtual double next(Random& random) = 0;
};

struct ErrorTiming {
  double step;              ///< seconds between samples
  double duration;          ///< of the line, seconds
  double correlation_time;  ///< seconds
};

std::unique_ptr<TrajectoryError> makeTrajectoryError(ErrorProcess process, double sigma,
                                                     const ErrorTiming& timing, Random& random);

}  // namespace pcl_als::simulation
