// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/report/report_origin.h>
#include <pcl_als/survey/survey_reader.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// The report of a calibration: report.html with pictures, and report.md.
class CalibrationPage {
 public:
  /// \param wanted false: no page is made, and observing costs nothing
  explicit CalibrationPage(bool wanted);
  ~CalibrationPage();
  CalibrationPage(const CalibrationPage&) = delete;
  CalibrationPage& operator=(const CalibrationPage&) = delete;

  /// Observer for the calibration, for the map; the page must exist as long as it is called.
  SurveyObserver observer();
  /// Writes the page into the folder of \a origin.
  void write(const ReportOrigin& origin, const CalibrationResult& result,
             const std::vector<SurveyArea>& areas,
             const std::shared_ptr<const Trajectory>& trajectory) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
