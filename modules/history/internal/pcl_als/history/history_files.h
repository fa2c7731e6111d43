// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/history/calibration_history.h>

namespace pcl_als {

/// What of which calibrations is combined.
struct HistoryInput {
  std::vector<std::filesystem::path> calibrations;
  /// Table of the missions, CSV: calibration (name of the file), date, further columns of numbers
  /// such as temperature; empty: none.
  std::filesystem::path missions;
  /// Name of the instrument: calibrations of others are excluded. Empty: all must have the same
  /// name, or none.
  std::string system_name;
  std::string system;  ///< of calibrations with several systems
  /// Calibrations that their verdict says not to apply are used as well.
  bool with_unusable = false;
};

/// The missions of calibration files.
struct HistoryMissions {
  std::vector<CalibrationMission> missions;
  CalibrationResult newest;           ///< the calibration of the last mission in order of time
  std::vector<std::string> excluded;  ///< "FILE: why it is not used"
};

/** \brief Reads calibration.json files and the table of their missions.
 *
 * Calibrations whose verdict says not to apply them, and those that are given twice, are excluded.
 * InputError for files that cannot be read, calibrations of different instruments or models
 * (rigorous, quasi-rigorous), a table without a row for a calibration, and where no calibration is
 * left.
 */
HistoryMissions readHistoryMissions(const HistoryInput& input);

}  // namespace pcl_als
