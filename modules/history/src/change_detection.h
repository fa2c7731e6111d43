// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include "history_model.h"

namespace pcl_als::detail {

/// A change with the term of the model that describes it.
struct DetectedChange {
  ParameterChange change;
  HistoryTerm term;
};

/** \brief Finds steps, drifts and outliers one after the other, each given those before.
 *
 * A further term is tested by its score statistic, z = score / standard deviation, in the
 * generalised least squares fit of all parameters together, so that correlations between
 * parameters are used. The most likely of the significant ones, by z^2 / 2 minus the logarithm of
 * the number of terms of its kind, is added, and kept where it or one more change explains the
 * missions better than random variation of the parameter does (Bayesian information criterion,
 * with the number of possible positions; probability of 0.9). Else the parameter varies.
 */
std::vector<DetectedChange> detectChanges(const std::vector<CalibrationMission>& missions,
                                          const HistoryOptions& options, bool dated);

}  // namespace pcl_als::detail
