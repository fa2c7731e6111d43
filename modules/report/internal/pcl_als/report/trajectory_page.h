// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pcl_als/processing/trajectory_from_points.h>
#include <pcl_als/report/report_origin.h>

namespace pcl_als {

/** \brief The report of a reconstructed trajectory: report.html with the path on a map, its
 * standard deviations and the residuals of rays over time, and what determined it; report.md.
 */
class TrajectoryPage {
 public:
  explicit TrajectoryPage(bool wanted);
  ~TrajectoryPage();
  TrajectoryPage(const TrajectoryPage&) = delete;
  TrajectoryPage& operator=(const TrajectoryPage&) = delete;

  /// ReconstructionOptions::observer, for the map; the page must exist as long as it is called.
  SurveyObserver observer();
  /// Writes the page into the folder of \a origin. \a files: of the points.
  void write(const ReportOrigin& origin, const ReconstructedTrajectory& flight,
             const std::vector<std::string>& files) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
