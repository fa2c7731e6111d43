// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <vector>

#include <pcl_als/common/large_correction.h>

#include "block.h"
#include "block_calibration.h"
#include "block_estimate.h"
#include "jump_search.h"

namespace pcl_als {

/// At most so many are listed.
inline constexpr std::size_t kMostLargeCorrections = 10;

/// What was found out before.
struct LargeCorrectionHints {
  std::optional<JumpSearch::Place> jump;  ///< of the trajectory, if there is one
  bool rejected_together = false;         ///< areRejectedTogether()
};

/** \brief The parts of strips in which the trajectory is wrong by more than ordinary errors, with
 * their probable causes; largest effect on the ground first.
 *
 * Found one after the other, as outliers are by data snooping: the adjustment distributes an error
 * of one strip over all strips at its place, in proportion to their a priori variances. The curve
 * with the strongest excursion (findExcursions()) therefore gets the a priori standard deviation of
 * its peak instead of that of ordinary errors, the adjustment is solved again with unchanged
 * observations and weights, and excursions are looked for in the other curves. What is listed are
 * the excursions of these curves in the last solution. The estimates of the calibration are not
 * changed. A point at the edge of the swath moves by: position, the error; pitch, times the height
 * of the sensor; roll, times the range; heading, times the lateral distance. Empty for a
 * calibration that has not converged.
 *
 * Where most pairs of a strip in some second were rejected, the search begins with the solution of
 * all pairs (solutionOfAll()).
 *
 * \param estimate with the pairs at all distances
 * \param errors of its solution, of all corrected strips
 * \param strips as measured, by index
 */
std::vector<LargeCorrection> largeCorrections(const SurveyBlock& block,
                                              const BlockEstimate& estimate,
                                              const std::vector<StripErrors>& errors,
                                              const std::vector<StripTrajectory>& strips,
                                              const LargeCorrectionHints& hints);

}  // namespace pcl_als
