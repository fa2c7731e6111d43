// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/file_protection.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/trajectory_io.h>
#include <pcl_als/io/trajectory_writer.h>
#include <pcl_als/processing/trajectory_conversion.h>
#include <pcl_als/trajectory/trajectory_correction.h>

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using Options = TrajectoryConversionOptions;

bool isSbet(const fs::path& output) {
  const std::string extension = lowerExtension(output);
  return extension == ".sbet" || extension == ".out";
}

LoadedTrajectory flightOf(const std::vector<fs::path>& paths, const Options& options) {
  TrajectoryLoadingOptions reading;
  if (options.calibration != nullptr) reading = trajectoryLoadingOptions(*options.calibration);
  static_cast<TrajectoryReading&>(reading) = options.reading;
  reading.keep_samples = true;
  return loadTrajectory(paths, reading);
}

std::vector<TrajectoryAccuracy> accuraciesOf(const std::vector<TrajectorySample>& samples,
                                             std::vector<TrajectoryAccuracy> known) {
  std::vector<TrajectoryAccuracy> accuracies;
  if (known.empty()) return accuracies;
  std::stable_sort(known.begin(), known.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  for (const TrajectorySample& sample : samples)
    accuracies.push_back(accuracyAt(known, sample.time));
  return accuracies;
}

/// Where the calibration states standard deviations after the strip corrections, they replace those
/// of the trajectory.
void addPosterior(const CorrectedTrajectory& corrected,
                  std::vector<TrajectoryAccuracy>& accuracies) {
  const auto isKnown = [](const Eigen::Vector3d& std) { return std.allFinite(); };
  const auto& positions = corrected.position_std;
  if (std::none_of(positions.begin(), positions.end(), isKnown)) return;
  accuracies.resize(corrected.samples.size());
  for (std::size_t i = 0; i < accuracies.size(); ++i) {
    accuracies[i].time = corrected.samples[i].time;
    if (!isKnown(positions[i])) continue;
    accuracies[i].position = positions[i];
    const Eigen::Vector3d& angles = corrected.angles_std[i];
    if (corrected.samples[i].hasAttitude())
      accuracies[i].angles = {angles.y(), angles.x(), angles.z()};
  }
}

/// Corrects samples and their standard deviations.
void correct(const Options& options, const LoadedTrajectory& flight,
             std::vector<TrajectorySample>& samples, std::vector<TrajectoryAccuracy>& accuracies,
             const std::vector<TrajectoryAccuracy>& known, ProgressReport& progress) {
  SystemCorrection::Options how;
  how.force = options.force;
  const bool other = isOfAnotherFlight(*options.calibration, flight.trajectory->startTime(),
                                       flight.trajectory->endTime());
  how.strip_corrections =
      options.strip_corrections && !other && !options.calibration->strip_errors.empty();
  const CorrectedTrajectory corrected =
      correctTrajectory(samples, *options.calibration, flight.trajectory, how);
  if (!corrected.flight_remark.empty()) progress.remark(corrected.flight_remark);
  samples = corrected.samples;
  accuracies = accuraciesOf(samples, known);
  for (std::size_t i = 0; i < accuracies.size(); ++i) {
    Eigen::Vector3d& position = accuracies[i].position;
    position = (position.cwiseAbs2() + corrected.lever_arm_variance[i]).cwiseSqrt();
  }
  addPosterior(corrected, accuracies);
  progress.remark(std::string("lever arm ") +
                  (how.strip_corrections ? "and strip corrections " : "") +
                  "taken out; boresight, range bias and scan angle scale are parameters of the "
                  "scanner and not part of a trajectory");
  if (corrected.excluded > 0) {
    progress.remark("excluded: " + grouped(corrected.excluded) +
                    " samples at times that the calibration does not cover");
  }
  if (corrected.angles_excluded) {
    progress.remark(
        "the corrections of pitch, roll and heading are not applied: the trajectory "
        "has no attitude");
  }
  if (samples.empty()) throw InputError("trajectory: no sample is covered by the calibration");
}

fs::path accuracyPath(fs::path output) {
  const std::string stem = output.stem().string();
  return output.replace_filename(stem + "_smrmsg.out");
}

}  // namespace

void checkTrajectoryOutput(const fs::path& output, const std::string& crs) {
  if (isSbet(output) && crs.empty()) {
    throw UsageError(
        output.string() +
            ": an SBET is in latitude and longitude, and the CRS of the coordinates, such as "
            "EPSG:25832, is not known",
        Hint::crs);
  }
  if (isSbet(output) || lowerExtension(output) == ".csv") return;
  throw UsageError(output.string() + ": a trajectory is written as .csv, .sbet or .out");
}

std::vector<fs::path> writeTrajectoryFile(const fs::path& output,
                                          const std::vector<TrajectorySample>& samples,
                                          const std::vector<TrajectoryAccuracy>& accuracy,
                                          const std::string& crs, bool reconstructed) {
  checkTrajectoryOutput(output, crs);
  std::vector<fs::path> written = {output};
  if (!isSbet(output)) {
    writeTrajectoryCsv(output, samples, accuracy, reconstructed);
    return written;
  }
  writeSbet(output, samples, crs);
  if (!accuracy.empty()) {
    written.push_back(accuracyPath(output));
    writeAccuracies(written.back(), accuracy);
  }
  return written;
}

TrajectoryConversion convertTrajectory(const std::vector<fs::path>& paths, const fs::path& output,
                                       const Options& options, const ProgressCallback& callback) {
  checkTrajectoryOutput(output, options.reading.crs);
  const UnchangedInputs unchanged;
  const FileProtection protection(trajectoryPaths(paths));
  protection.check(output);
  if (isSbet(output)) protection.check(accuracyPath(output));
  ProgressReport progress(callback);
  progress.begin("Reading " + counted(paths.size(), "trajectory file"));
  LoadedTrajectory flight = flightOf(paths, options);
  progress.end(grouped(flight.samples.size()) + " samples");
  progress.remark(flight.format + ": " + flight.frame);
  for (const std::string& text : flight.remarks) progress.remark(text);
  std::vector<TrajectorySample> samples = std::move(flight.samples);
  const std::vector<TrajectoryAccuracy>& known =
      options.accuracy.empty() ? flight.accuracy : options.accuracy;
  std::vector<TrajectoryAccuracy> accuracies = accuraciesOf(samples, known);
  if (options.calibration != nullptr)
    correct(options, flight, samples, accuracies, known, progress);
  if (accuracies.empty())
    progress.remark("no standard deviations are written: the trajectory states none");
  progress.begin("Writing " + output.string());
  const TrajectoryConversion conversion{
      samples.size(), writeTrajectoryFile(output, samples, accuracies, options.reading.crs,
                                          flight.reconstructed())};
  progress.end(grouped(samples.size()) + " samples");
  return conversion;
}

}  // namespace pcl_als
