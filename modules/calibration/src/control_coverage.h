// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/survey/survey_map.h>

namespace pcl_als {

/// Where control lies with respect to the strips.
struct ControlCoverage {
  std::string objection;  ///< why it cannot be that of the strips; empty where some of it may be
  std::string remark;     ///< where none of it can be used; empty where some of it may be
};

/** \brief Finds control that is in another coordinate reference system or unit than the strips.
 *
 * An objection where no point lies within any strip and the reason is known (OffsetFromBlock), or
 * the nearest is more than 20 km away; and where all points that lie within strips are more than 10
 * m above or below the lowest last return around them.
 *
 * \param strips indices of the strips that are used
 */
ControlCoverage coverageOf(const std::vector<ControlPoint>& control, const SurveyMap& map,
                           const std::vector<int>& strips);

}  // namespace pcl_als
