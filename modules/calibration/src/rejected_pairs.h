// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include "block_solution.h"
#include "pair_set.h"

namespace pcl_als {

/** \brief Whether most pairs of a strip in some second have no weight: rejected, or beyond the
 * threshold.
 *
 * Mismatched pairs are a few everywhere. Most of a second are lost where the trajectory is wrong by
 * more than the distances at which pairs are formed.
 *
 * \param pairs as adjusted, with those beyond the threshold apart
 * \param weights of the observations
 */
bool areRejectedTogether(const PairSet& pairs, const std::vector<std::vector<double>>& weights);

/** \brief The solution of all pairs, the rejected ones and those beyond the threshold included.
 *
 * Huber weights without rejection let the trajectory errors follow pairs that agree with each
 * other; then outliers are rejected by the residuals of this solution. Parameters that are
 * estimated and variance components are those of \a solution.
 *
 * \param pairs all of them
 */
BlockSolution solutionOfAll(const BlockSolution& solution, const PairSet& pairs, int threads);

}  // namespace pcl_als
