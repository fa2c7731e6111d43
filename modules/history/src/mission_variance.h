// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include "history_model.h"

namespace pcl_als::detail {

/** \brief Logarithm of the likelihood of the missions up to a constant, with random changes of the
 * standard deviations \a change_std and the terms of a model.
 *
 * log L = -1/2 (sum of log |I + S L S| + sum of squares of the residuals), S = diag(change_std);
 * the restricted likelihood has the logarithm of the determinant of the normal matrix as well.
 */
double logLikelihood(const std::vector<CalibrationMission>& missions,
                     const SystemVector& change_std, const std::vector<HistoryTerm>& terms,
                     bool restricted);

/// The most likely standard deviation of random changes of one parameter, with those of the others
/// as given, and the logarithm of the likelihood there.
struct MostLikelyChange {
  double std = 0.0;
  double log_likelihood = 0.0;
};
MostLikelyChange mostLikelyChange(const std::vector<CalibrationMission>& missions, int parameter,
                                  SystemVector change_std, const std::vector<HistoryTerm>& terms,
                                  bool restricted);

/// Standard deviations of random changes between missions by restricted maximum likelihood (REML),
/// for parameters that at least three missions determine; those that \a known states (not NaN) are
/// kept.
SystemVector changeStdByReml(const std::vector<CalibrationMission>& missions,
                             const std::vector<HistoryTerm>& terms, const SystemVector& known);

}  // namespace pcl_als::detail
