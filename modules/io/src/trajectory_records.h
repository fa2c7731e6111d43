// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/io/trajectory_io.h>

namespace pcl_als::detail {

/// The records of a trajectory file before they are brought to the frame of the points.
struct TrajectoryRecords {
  std::string format, columns;
  TrajectoryCoordinates coordinates = TrajectoryCoordinates::map;
  AttitudeForm attitude = AttitudeForm::heading;
  bool heading_is_true = false;              ///< stated by the name of the column
  bool orthometric = false;                  ///< heights are above a geoid
  std::vector<TrajectorySample> samples;     ///< positions: metres, or latitude, longitude (rad)
  SamplePlaces places;                       ///< of the samples
  std::vector<double> turns;                 ///< as in TrajectoryFile
  std::vector<TrajectoryAccuracy> accuracy;  ///< of the samples, or empty
  std::vector<std::string> remarks;
};

/// Reads by the extension: .out and .sbet are SBET, .trj TerraScan, .pof RIEGL, .sol Leica, all
/// others text.
TrajectoryRecords readTrajectoryRecords(const std::filesystem::path& path,
                                        const TrajectoryReading& reading);

TrajectoryRecords readTextTrajectory(const std::filesystem::path& path,
                                     const TrajectoryReading& reading);

/// Whether a file is one of standard deviations (smrmsg) by its name.
bool isNamedAsAccuracy(const std::filesystem::path& path);
/// Whether a file that is no trajectory holds standard deviations of one: by its name or its
/// records (smrmsg, .poq).
bool holdsAccuracies(const std::filesystem::path& path);

/// The records in the frame of the points. \a path: for messages.
TrajectoryFile inPointFrame(TrajectoryRecords records, const std::filesystem::path& path,
                            const TrajectoryReading& reading);

/// "latitude, longitude and ellipsoidal height, WGS 84 (ITRF) assumed"
std::string frameText(const TrajectoryRecords& records, const TrajectoryReading& reading);

}  // namespace pcl_als::detail
