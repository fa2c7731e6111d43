// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/large_correction.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/drawing/block_map.h>
#include <pcl_als/report/html_report.h>
#include <pcl_als/report/report_origin.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {

inline constexpr PictureSize kWide{1400, 640}, kTall{1400, 900}, kSquare{1200, 900};

/// Conclusion from a result, in sentences.
struct Verdict {
  VerdictGrade grade = VerdictGrade::attention;
  std::string headline;
  std::vector<std::string> sentences;
};

/// The strips of a survey and the cells that they cover, collected while a job reads the points.
struct ObservedBlock {
  std::vector<std::string> strips;
  std::unique_ptr<StripCoverage> coverage;  ///< null until the survey is known

  /// For the job that reads; this object must outlive it.
  SurveyObserver observer();
};

/// "2.9 cm"
std::string centimetres(double metres);

void addVerdict(const Verdict& verdict, HtmlReport& report);
/// A section with a map of strips, overlaps, areas and control, where there are any.
/// \param corrections marked along the flight path by their numbers, from 1
void addMap(const std::vector<ControlPoint>& control, const StripCoverage& coverage,
            const std::vector<std::string>& strips, const std::vector<SurveyArea>& areas,
            HtmlReport& report, const std::vector<LargeCorrection>& corrections = {});
void addWarnings(const Warnings& warnings, HtmlReport& report);
/// Inputs (points, then those of the origin) with sizes and times, and all settings.
void addOrigin(const ReportOrigin& origin, const std::vector<std::string>& inputs,
               HtmlReport& report);

}  // namespace pcl_als
