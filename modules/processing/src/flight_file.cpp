// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/flight_file.h>
#include <pcl_als/trajectory/heading_check.h>
#include <pcl_als/trajectory/trajectory_screening.h>

namespace pcl_als {
namespace {

/// A column called yaw is clockwise from north or counter-clockwise from east: the course decides.
std::string decideYaw(TrajectoryFile& file) {
  if (!file.heading_is_yaw) return {};
  const HeadingCheck check = headingCheck(file.samples);
  constexpr auto kFromEast = HeadingReading::from_east_counter_clockwise;
  if (check.followsCourse() || check.deviation(kFromEast) > HeadingCheck::kLargestCrab) return {};
  for (TrajectorySample& sample : file.samples) {
    sample.heading = headingFrom(kFromEast, sample.heading);
  }
  return "yaw is counter-clockwise from east, as the course shows: heading = 90 degrees - yaw";
}

/// Leaves out samples that contradict their neighbours.
void leaveOutOutliers(TrajectoryFile& file, const std::filesystem::path& path) {
  const TrajectoryScreening screening = screenTrajectory(file.samples);
  const auto name = [&](std::size_t sample) { return file.places.name(sample); };
  const std::string objection = screening.objection(name);
  if (!objection.empty()) throw InputError(path.string() + ": " + objection);
  if (screening.outliers.empty()) return;
  file.remarks.push_back(path.filename().string() + ": " + screening.describe(name));
  const std::vector<std::size_t> outliers = screening.indices();
  removeAt(file.samples, outliers);
  removeAt(file.places.numbers, outliers);
  if (!file.accuracy.empty()) removeAt(file.accuracy, outliers);
}

/// Each file is screened by itself, before its samples are compared with those of the others.
TrajectoryFile readScreened(const std::vector<std::filesystem::path>& paths,
                            const TrajectoryReading& reading) {
  const std::vector<std::filesystem::path> files = trajectoryPaths(paths);
  std::vector<TrajectoryFile> parts;
  for (const std::filesystem::path& path : files) {
    parts.push_back(readTrajectoryFile(path, reading));
    leaveOutOutliers(parts.back(), path);
  }
  return joinTrajectoryFiles(std::move(parts), files);
}

}  // namespace

FlightFileOptions flightFileOptions(const CalibrationResult& calibration) {
  FlightFileOptions options;
  options.line_fit_half_width = calibration.line_fit_half_width;
  switch (calibration.attitude) {
    case AttitudeSource::trajectory:
      options.attitude = AttitudeUse::needed;
      break;
    case AttitudeSource::nominal:
      options.attitude = AttitudeUse::nominal;
      break;
    case AttitudeSource::none:
    case AttitudeSource::points:
      options.attitude = AttitudeUse::ignore;
      break;
  }
  return options;
}

FlightFile readFlight(const std::filesystem::path& path, const FlightFileOptions& options) {
  return readFlight(std::vector<std::filesystem::path>{path}, options);
}

FlightFile readFlight(const std::vector<std::filesystem::path>& paths,
                      const FlightFileOptions& options) {
  TrajectoryFile file = readScreened(paths, options);  // refuses an empty list
  return flightOf(std::move(file), paths.front().string(), options);
}

FlightFile flightOf(TrajectoryFile file, const std::string& name,
                    const FlightFileOptions& options) {
  const std::string yaw = decideYaw(file);
  const bool complete = !file.samples.empty() &&
                        std::all_of(file.samples.begin(), file.samples.end(),
                                    [](const TrajectorySample& s) { return s.hasAttitude(); });
  if (options.attitude == AttitudeUse::needed && !complete) {
    throw InputError(name +
                     ": has no roll, pitch and heading for every sample; the rigorous model "
                     "needs them");
  }
  Trajectory::Options use;
  if (options.line_fit_half_width > 0.0) use.line_fit_half_width = options.line_fit_half_width;
  use.nominal_attitude = options.attitude == AttitudeUse::nominal;
  use.use_attitude = complete && (options.attitude == AttitudeUse::where_given ||
                                  options.attitude == AttitudeUse::needed);
  use.screen_samples = false;
  FlightFile flight;
  if (options.keep_samples) flight.samples = file.samples;
  flight.trajectory = std::make_shared<const Trajectory>(std::move(file.samples), use);
  flight.format = file.format;
  flight.frame = file.frame;
  flight.accuracy = std::move(file.accuracy);
  flight.remarks = std::move(file.remarks);
  if (!file.columns.empty()) flight.remarks.insert(flight.remarks.begin(), file.columns);
  if (use.use_attitude && !yaw.empty()) flight.remarks.push_back(yaw);
  const std::vector<std::string>& repairs = flight.trajectory->repairs();
  flight.remarks.insert(flight.remarks.end(), repairs.begin(), repairs.end());
  return flight;
}

}  // namespace pcl_als
