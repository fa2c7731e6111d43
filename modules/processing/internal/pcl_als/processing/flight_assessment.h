// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/trajectory_loading.h>
#include <pcl_als/survey/survey_reader.h>
#include <pcl_als/trajectory/scanner_detection.h>

namespace pcl_als {

struct StripScanner {
  std::string strip;
  DetectedScanner scanner;
};

/// What points show of the trajectory that is used with them.
struct FlightAssessment {
  std::vector<StripScanner> scanners;  ///< in the order of the strips
  std::vector<std::string> notes;      ///< how times and strips were reconciled with the trajectory
  Warnings warnings;                   ///< what jobs with this trajectory refuse or warn of
};

/** \brief Compares the points of files with a trajectory as calibrations do
 * (TrajectoryPlausibility), and detects the scanner of each strip; reads all points once.
 *
 * Nothing is thrown where points or trajectory are unusable or do not belong together: the warnings
 * say so.
 *
 * \param choice lines are divided as in calibrations
 * \param reading with an empty crs: that of the points
 * \param threads 0: all cores
 */
FlightAssessment assessFlight(const std::vector<std::string>& files, const PointWindow& window,
                              StripChoice choice,
                              const std::vector<std::filesystem::path>& trajectory,
                              const TrajectoryReading& reading, int threads = 0);

/// One line for each scanner, with the strips that it measured: "scanner of 1, 2: oscillating".
std::vector<std::string> describe(const std::vector<StripScanner>& scanners);

}  // namespace pcl_als
