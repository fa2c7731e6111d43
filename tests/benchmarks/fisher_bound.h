// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "matched_block.h"

namespace pcl_als::bench {

/** \brief What range noise alone leaves of the parameters, were every pair found without error.
 *
 * Both are standard deviations in internal units, zero for parameters that are not estimated.
 */
struct FisherBound {
  /// Eq. (26) with the true noise: N^-1 with every pair's variance n'Sigma n from the range noise
  /// of its point and of the patch's three vertices, as if pairs shared nothing.
  SystemVector independent = SystemVector::Zero();
  /// The exact one of the same least squares estimate: points serve as vertices of many patches and
  /// look for patches themselves, so that pairs share noise: N^-1 (sum over points g g') N^-1.
  SystemVector shared = SystemVector::Zero();
};

/// \a block corrected by the true biases; \a range: true noise, metres.
FisherBound fisherBound(const MatchedBlock& block, double range,
                        const std::vector<SystemParameter>& estimate);

}  // namespace pcl_als::bench
