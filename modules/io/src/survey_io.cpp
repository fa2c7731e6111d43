// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <numeric>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/io/survey_io.h>

#include "leica_sol.h"
#include "riegl_pof.h"
#include "sbet.h"
#include "terrascan_trj.h"
#include "trajectory_records.h"
#include "week_rollover.h"

namespace pcl_als {

namespace detail {
namespace {

TrajectoryRecords readByExtension(const std::filesystem::path& path,
                                  const TrajectoryReading& reading) {
  const std::string extension = lowerExtension(path);
  if (extension == ".out" || extension == ".sbet") return readSbet(path, reading);
  if (extension == ".trj") return readTerrascanTrajectory(path, reading);
  if (extension == ".pof") return readRieglTrajectory(path, reading);
  if (extension == ".sol") return readLeicaTrajectory(path, reading);
  return readTextTrajectory(path, reading);
}

/// What is no trajectory may be the file of its standard deviations, which stands beside it.
TrajectoryRecords readOrRecognise(const std::filesystem::path& path,
                                  const TrajectoryReading& reading) {
  try {
    return readByExtension(path, reading);
  } catch (const InputError&) {
    if (!holdsAccuracies(path)) throw;
  }
  throw InputError(path.string() +
                       ": holds the standard deviations of a trajectory, not its positions: give "
                       "the trajectory itself as the trajectory",
                   Hint::accuracy);
}

}  // namespace

TrajectoryRecords readTrajectoryRecords(const std::filesystem::path& path,
                                        const TrajectoryReading& reading) {
  TrajectoryRecords records = readOrRecognise(path, reading);
  if (!records.places.lines) {
    records.places.numbers.resize(records.samples.size());
    std::iota(records.places.numbers.begin(), records.places.numbers.end(), 1U);
  }
  unwrapWeek(records.samples);
  for (std::size_t i = 0; i < records.accuracy.size(); ++i)
    records.accuracy[i].time = records.samples[i].time;
  return records;
}

}  // namespace detail

TrajectoryFile readTrajectoryFile(const std::filesystem::path& path,
                                  const TrajectoryReading& reading) {
  return detail::inPointFrame(detail::readTrajectoryRecords(path, reading), path, reading);
}

TrajectoryFile readTrajectoryFile(const std::filesystem::path& path, const std::string& crs,
                                  const LengthUnit& unit) {
  TrajectoryReading reading;
  reading.crs = crs;
  reading.unit = unit;
  return readTrajectoryFile(path, reading);
}

std::vector<TrajectorySample> readTrajectory(const std::filesystem::path& path,
                                             const std::string& crs, const LengthUnit& unit) {
  return readTrajectoryFile(path, crs, unit).samples;
}

}  // namespace pcl_als
