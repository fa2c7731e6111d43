// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/history/history_files.h>
#include <pcl_als/io/applied_correction.h>
#include <pcl_als/io/mission_table.h>
#include <pcl_als/io/survey_io.h>

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

/// Refuses calibrations of different instruments; those without a name belong to any.
void requireSameSystem(const std::vector<CalibrationResult>& used,
                       const CalibrationResult& calibration, const std::string& name) {
  for (const CalibrationResult& other : used)
    if (!calibration.system_name.empty() && !other.system_name.empty() &&
        calibration.system_name != other.system_name)
      throw InputError(name + ": is of the instrument " + calibration.system_name +
                           ", others are of " + other.system_name + "; a history is of one",
                       Hint::system_name);
}

/// Sets date and covariates from the row of a calibration file.
void describe(const std::vector<MissionRow>& table, const fs::path& table_file,
              const fs::path& file, CalibrationMission& mission) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const MissionRow& row) {
    const fs::path named(row.calibration);
    return named == file || named == file.filename() || named == file.stem();
  });
  if (found == table.end())
    throw InputError(table_file.string() + ": has no row for the calibration " +
                     file.filename().string());
  if (found->day) mission.day = found->day;
  mission.covariates = found->values;
}

}  // namespace

HistoryMissions readHistoryMissions(const HistoryInput& input) {
  HistoryMissions result;
  std::vector<MissionRow> table;
  if (!input.missions.empty()) table = readMissionTable(input.missions);
  std::vector<CalibrationResult> used;
  std::set<std::string> ids;
  for (const fs::path& file : input.calibrations) {
    CalibrationResult calibration = readCalibration(file);
    if (!calibration.verdict.usable() && !input.with_unusable) {
      result.excluded.push_back(file.string() + ": not used, " + calibration.verdict.text());
      continue;
    }
    if (!input.system_name.empty() && calibration.system_name != input.system_name) {
      result.excluded.push_back(file.string() + ": not used, it is of " +
                                (calibration.system_name.empty()
                                     ? std::string("an instrument without a name")
                                     : "the instrument " + calibration.system_name));
      continue;
    }
    if (!ids.insert(calibrationId(calibration)).second) {
      result.excluded.push_back(file.string() + ": not used, it repeats another calibration");
      continue;
    }
    requireSameSystem(used, calibration, file.string());
    if (!used.empty() && modelName(used.front().attitude) != modelName(calibration.attitude))
      throw InputError(file.string() + ": is of the " +
                       std::string(modelName(calibration.attitude)) + " model, others of the " +
                       std::string(modelName(used.front().attitude)) +
                       " model; their parameters cannot be combined");
    CalibrationMission mission = missionOf(calibration, file.string(), input.system);
    if (!table.empty()) describe(table, input.missions, file, mission);
    result.missions.push_back(std::move(mission));
    used.push_back(std::move(calibration));
  }
  if (used.empty())
    throw InputError("no calibration can be used: " + (result.excluded.empty()
                                                           ? std::string("none is given")
                                                           : result.excluded.front()));
  std::size_t newest = used.size() - 1;
  for (std::size_t m = 0; m < used.size(); ++m)
    if (result.missions[m].day && result.missions[newest].day &&
        *result.missions[m].day >= *result.missions[newest].day)
      newest = m;
  result.newest = std::move(used[newest]);
  return result;
}

}  // namespace pcl_als
