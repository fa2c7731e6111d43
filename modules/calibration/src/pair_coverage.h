// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/survey/survey_map.h>

namespace pcl_als {

/// Two strips that overlap and were to be compared.
struct OverlappingPair {
  std::string a, b;
  SurveyMap::HeightOffset height;  ///< of a above b
};

/** \brief Says which overlapping pairs were not compared, and whether the block falls into parts.
 *
 * A pair was compared if it has correspondences. It is too far apart if its height offset exceeds
 * \a limit (metres, the largest distance of correspondences) and it has none, or only those of
 * different objects: their distances fill the range of the search, and their RMS exceeds a quarter
 * of it (0.58 where they are uniform).
 *
 * Pairs that are too far apart become a warning; where no compared pair joins their strips, also
 * over others, the heights of the parts contradict each other and the result is not usable. Pairs
 * without a smooth surface in common are counted in the verdict, and a strip that has no other
 * pairs is named in a warning.
 *
 * \param result its pairs, warnings and verdict; call after judgeCalibration()
 */
void judgePairCoverage(const std::vector<OverlappingPair>& pairs, double limit,
                       CalibrationResult& result);

}  // namespace pcl_als
