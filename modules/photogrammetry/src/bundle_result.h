// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include "bundle_normal.h"
#include "bundle_problem.h"

namespace pcl_als::photogrammetry {

/// The images that too few measurements determine, as a message; empty: none.
std::string tooFewMeasurements(const BundleProblem& problem);

/// Fills a result with the estimate, and with covariances and tests where \a inverted.
void describe(const BundleProblem& problem, const BundleNormal& normal, bool inverted,
              BundleResult& result);

}  // namespace pcl_als::photogrammetry
