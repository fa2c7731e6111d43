// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/drawing/block_map.h>
#include <pcl_als/report/quality_report.h>
#include <pcl_als/report/report_origin.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {

/// The report of a check: report.html with pictures, and report.md.
class QualityPage {
 public:
  explicit QualityPage(bool wanted);
  ~QualityPage();
  QualityPage(const QualityPage&) = delete;
  QualityPage& operator=(const QualityPage&) = delete;

  /// Observer for the check, for the map; the page must exist as long as it is called.
  SurveyObserver observer();
  /// What was observed: the strips, and the cells with their points.
  const std::vector<std::string>& strips() const;
  const StripCoverage& coverage() const;
  /// Writes the page into the folder of \a origin.
  void write(const ReportOrigin& origin, const QualityReport& report,
             const std::vector<SurveyArea>& areas) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
