// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/io/survey_io.h>

#include "sbet.h"
#include "trajectory_csv.h"
#include "week_rollover.h"

namespace pcl_als {
namespace {

bool isSbet(const std::filesystem::path& path) {
  const std::string extension = lowerExtension(path);
  return extension == ".out" || extension == ".sbet";
}

}  // namespace

TrajectoryFile readTrajectoryFile(const std::filesystem::path& path, const std::string& crs,
                                  const LengthUnit& unit) {
  TrajectoryFile file;
  if (isSbet(path)) {
    if (!unit.isMetre())
      throw UsageError(path.string() + ": an SBET is in degrees and metres; its unit is not " +
                       unit.name);
    file.samples = detail::readSbet(path, crs);
  } else {
    file = detail::readTrajectoryCsv(path);
  }
  for (TrajectorySample& sample : file.samples) sample.position *= unit.metres;
  detail::unwrapWeek(file.samples);
  return file;
}

std::vector<TrajectorySample> readTrajectory(const std::filesystem::path& path,
                                             const std::string& crs, const LengthUnit& unit) {
  return readTrajectoryFile(path, crs, unit).samples;
}

}  // namespace pcl_als
