// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/trajectory_loading.h>
#include <pcl_als/trajectory/attitude_axes.h>
#include <pcl_als/trajectory/trajectory_screening.h>

namespace pcl_als {
namespace {

bool hasAttitude(const std::vector<TrajectorySample>& samples) {
  return !samples.empty() && std::all_of(samples.begin(), samples.end(),
                                         [](const TrajectorySample& s) { return s.hasAttitude(); });
}

/// Settles what files leave open of their attitudes; what the course does not show is refused where
/// the attitude may be used, and unknown where it is not.
void settleAttitudes(const std::vector<TrajectoryFile*>& files,
                     const std::vector<std::string>& names, AttitudeUse use) {
  std::vector<OpenAttitude> attitudes;
  for (TrajectoryFile* file : files)
    attitudes.push_back({file->attitude, file->samples, file->turns});
  const std::vector<AxesByCourse> found = settleAxes(attitudes);
  for (std::size_t i = 0; i < files.size(); ++i) {
    TrajectoryFile& file = *files[i];
    if (file.attitude == AttitudeForm::heading) continue;
    const std::string text = describe(found[i], file.attitude);
    if (found[i] != AxesByCourse::undecided) {
      file.axes = text;
    } else if (hasAttitude(file.samples) &&
               (use == AttitudeUse::where_given || use == AttitudeUse::needed)) {
      throw InputError(names[i] + ": " + text, Hint::axes);
    } else {
      for (TrajectorySample& sample : file.samples)
        sample.roll = sample.pitch = sample.heading = std::numeric_limits<double>::quiet_NaN();
    }
    file.attitude = AttitudeForm::heading;
    file.turns.clear();
  }
}

/// Excludes samples that contradict their neighbours.
void excludeOutliers(TrajectoryFile& file, const std::filesystem::path& path) {
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
  if (!file.turns.empty()) removeAt(file.turns, outliers);
}

/// Each file is screened by itself, before its samples are compared with those of the others; so
/// are its attitudes settled.
TrajectoryFile readScreened(const std::vector<std::filesystem::path>& paths,
                            const TrajectoryLoadingOptions& options) {
  const std::vector<std::filesystem::path> files = trajectoryPaths(paths);
  std::vector<TrajectoryFile> parts;
  std::vector<std::string> names;
  for (const std::filesystem::path& path : files) {
    parts.push_back(readTrajectoryFile(path, options));
    excludeOutliers(parts.back(), path);
    names.push_back(path.string());
  }
  std::vector<TrajectoryFile*> all;
  for (TrajectoryFile& part : parts) all.push_back(&part);
  settleAttitudes(all, names, options.attitude);
  return joinTrajectoryFiles(std::move(parts), files);
}

}  // namespace

TrajectoryLoadingOptions trajectoryLoadingOptions(const CalibrationResult& calibration) {
  TrajectoryLoadingOptions options;
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

LoadedTrajectory loadTrajectory(const std::filesystem::path& path,
                                const TrajectoryLoadingOptions& options) {
  return loadTrajectory(std::vector<std::filesystem::path>{path}, options);
}

LoadedTrajectory loadTrajectory(const std::vector<std::filesystem::path>& paths,
                                const TrajectoryLoadingOptions& options) {
  TrajectoryFile file = readScreened(paths, options);  // refuses an empty list
  return flightOf(std::move(file), paths.front().string(), options);
}

LoadedTrajectory flightOf(TrajectoryFile file, const std::string& name,
                          const TrajectoryLoadingOptions& options) {
  settleAttitudes({&file}, {name}, options.attitude);
  const bool complete = hasAttitude(file.samples);
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
  LoadedTrajectory flight;
  if (options.keep_samples) flight.samples = file.samples;
  flight.trajectory = std::make_shared<const Trajectory>(std::move(file.samples), use);
  flight.format = file.format;
  flight.frame = file.frame;
  flight.accuracy = std::move(file.accuracy);
  flight.remarks = std::move(file.remarks);
  if (!file.columns.empty()) flight.remarks.insert(flight.remarks.begin(), file.columns);
  if (use.use_attitude && !file.axes.empty()) flight.remarks.push_back(file.axes);
  const std::vector<std::string>& repairs = flight.trajectory->repairs();
  flight.remarks.insert(flight.remarks.end(), repairs.begin(), repairs.end());
  return flight;
}

std::vector<std::pair<std::string, TrajectoryFacts>> inspectFlight(
    const std::vector<std::filesystem::path>& paths, const TrajectoryReading& reading) {
  std::vector<std::pair<std::string, TrajectoryFacts>> flight;
  for (const std::filesystem::path& path : trajectoryPaths(paths))
    flight.emplace_back(path.string(), inspectTrajectory(path, reading));
  const std::vector<double> no_turns;  // local coordinates have the north of the file
  std::vector<OpenAttitude> attitudes;
  for (auto& [path, facts] : flight)
    attitudes.push_back({facts.attitude_form, facts.local, no_turns});
  const std::vector<AxesByCourse> found = settleAxes(attitudes);
  for (std::size_t i = 0; i < flight.size(); ++i) {
    TrajectoryFacts& facts = flight[i].second;
    facts.axes = describe(found[i], facts.attitude_form);
    if (found[i] != AxesByCourse::undecided) facts.attitude_form = AttitudeForm::heading;
  }
  return flight;
}

}  // namespace pcl_als
