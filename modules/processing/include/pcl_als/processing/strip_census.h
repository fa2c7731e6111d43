// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <pcl_als/io/survey_census.h>
#include <pcl_als/processing/flight_file.h>
#include <pcl_als/survey/strip_arrangement.h>

namespace pcl_als {

/// Which points of which files are listed, and how.
struct CensusRequest {
  std::vector<std::filesystem::path> files;
  double cell = 0.0;  ///< metres, as for takeCensus()
  StripChoice strips;
  PointWindow window;
  /// Of the flight; empty: strips are those of the points alone.
  std::vector<std::filesystem::path> trajectory;
  TrajectoryReading reading;  ///< with an empty crs: that of the points
  int threads = 0;            ///< 0: all cores
};

struct StripCensusResult {
  SurveyCensus census;
  std::vector<LeftOutPoints> left_out;
  std::vector<std::string> notes;  ///< how strips were divided and times reconciled
};

/** \brief takeCensus() of files with their points arranged into strips with their trajectory, as by
 * the jobs that use one.
 *
 * Points that the trajectory does not cover are listed too. Where points or trajectory are unusable
 * or do not belong together, strips are those of the points alone, and a note gives the reason.
 */
StripCensusResult takeCensus(const CensusRequest& request,
                             const std::function<void(double)>& progress = {});

}  // namespace pcl_als
