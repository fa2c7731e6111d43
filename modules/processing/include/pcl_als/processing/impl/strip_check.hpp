// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/strip_check.h>

namespace pcl_als {

template <typename PointT>
void StripCheck<PointT>::check() {
  check_.reset();
  if (strips_.size() == 0) throw UsageError("StripCheck: no strips are set");
  SurveyReader survey =
      SurveyReader::ofInputs(strips_.inputs(alignment_), options_.settings.threads);
  check_ = checkSurvey(survey, trajectory_, options_, progress_);
}

template <typename PointT>
const SurveyCheck& StripCheck<PointT>::requireCheck() const {
  if (!check_) throw UsageError("StripCheck: check() has given no result yet");
  return *check_;
}

}  // namespace pcl_als
