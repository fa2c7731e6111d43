// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>

#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {

/// Receives the points that a job reads, for further maps and statistics; both may be empty.
struct SurveyObserver {
  /// Called when the strips have been chosen.
  std::function<void(const SurveyReader& survey)> begin;
  /// All points of one reading; from several threads for different strips.
  SurveyReader::Sink points;
};

}  // namespace pcl_als
