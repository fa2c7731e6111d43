// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>

#include <pcl_als/drawing/section_search.h>
#include <pcl_als/survey/survey_reader.h>
#include <pcl_als/trajectory/bias_evaluator.h>

namespace pcl_als {

/// A section through a survey before and after a correction, by strip.
struct SurveyProfile {
  SectionSearch::Place place;
  SectionPoints before, after;
};

/** \brief The gable roof or slope of a survey at which a misfit of its strips is most visible;
 * empty where no two strips cover one.
 *
 * Reads all points twice, in this process alone. Memory: that of SectionSearch during the search,
 * then the section's points.
 */
std::optional<SurveyProfile> findProfile(const SurveyReader& survey,
                                         const BiasEvaluator& correction);

}  // namespace pcl_als
