// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pcl_als {

/// A row of a table of missions.
struct MissionRow {
  std::string calibration;               ///< name of the calibration file
  std::optional<long> day;               ///< date of the flight, days since 1980-01-06
  std::map<std::string, double> values;  ///< the other columns by their names
};

/// Reads a table of missions, CSV: calibration, date (2026-05-04 or 04.05.2026; may be absent or
/// empty), and columns of numbers such as temperature (a field may be empty). InputError that names
/// file, line and column; also for a calibration that has two rows, and for a table without rows.
std::vector<MissionRow> readMissionTable(const std::filesystem::path& path);

}  // namespace pcl_als
