// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/processing/trajectory_conversion.h>
#include <pcl_als/processing/trajectory_from_points.h>
#include <pcl_als/survey/surveyed_file.h>

#include "reconstructed_attitude.h"

namespace pcl_als {
namespace {

void readPoints(const SurveyReader& survey, const SurveyObserver& observer,
                TrajectoryReconstruction& reconstruction) {
  if (observer.begin) observer.begin(survey);
  for (const std::string& name : survey.strips()) reconstruction.addStrip(name);
  survey.read(SurveyReader::asReturns([&](int strip, const LidarReturn* points, std::size_t count) {
    reconstruction.add(strip, points, count);
    if (observer.points) observer.points(strip, points, count);
  }));
}

/// Samples of the paths in order of time; where paths overlap, those of the earlier one.
void joinSamples(ReconstructedTrajectory& flight) {
  for (const ReconstructedPath& path : flight.paths) {
    if (!path.found) continue;
    for (const PathSample& point : path.samples) {
      if (!flight.samples.empty() && point.time <= flight.samples.back().time) continue;
      TrajectorySample& sample = flight.samples.emplace_back();
      sample.time = point.time;
      sample.position = point.position;
      TrajectoryAccuracy& accuracy = flight.accuracy.emplace_back();
      accuracy.time = point.time;
      accuracy.position = point.covariance.diagonal().cwiseSqrt();
    }
  }
}

std::string summaryOf(const ReconstructedPath& path) {
  char text[240];
  const Eigen::Vector3d std = path.meanStd();
  const std::string evidence =
      path.angles.used ? (path.rays > path.rejected ? "rays and scan angles" : "scan angles")
                       : "rays";
  std::snprintf(text, sizeof text,
                ": %.3f to %.3f s, %.0f m above ground, std %.3f %.3f %.3f m (east north up) from "
                "%s, %zu rays, %.1f m between returns",
                path.times.first, path.times.last, path.height, std.x(), std.y(), std.z(),
                evidence.c_str(), path.rays - path.rejected, path.separation);
  return "strip " + path.name + text;
}

/// What was assumed and found about recorded scan angles; empty where they are not used.
std::string anglesOf(const ReconstructedPath& path) {
  const ReconstructedPath::Angles& angles = path.angles;
  if (!angles.used) return {};
  char text[200];
  std::snprintf(text, sizeof text,
                "strip %s: recorded scan angles are positive to the %s; scale %+.2f %% (std %.2f), "
                "offset %+.2f degrees (std %.2f), changes with time %.2f degrees (roll)",
                path.name.c_str(), angles.right_positive ? "right" : "left", 100.0 * angles.scale,
                100.0 * angles.scale_std, angles.offset / kRadiansPerDegree,
                angles.offset_std / kRadiansPerDegree, angles.roll / kRadiansPerDegree);
  return text;
}

/// Warnings of all paths; reasons of those that were not found.
void collectFindings(ReconstructedTrajectory& flight, ProgressReport& progress) {
  double all = 0.0, found = 0.0;
  std::string reason;
  for (const ReconstructedPath& path : flight.paths) {
    flight.warnings.insert(flight.warnings.end(), path.warnings.begin(), path.warnings.end());
    all += path.points;
    if (path.found) {
      found += path.determined * path.points;
      progress.remark(summaryOf(path));
      progress.remark(anglesOf(path));
      continue;
    }
    const std::string text = "strip " + path.name + ": no trajectory: " + path.reason;
    if (reason.empty()) reason = text;
    flight.warnings.emplace_back(text);
  }
  if (flight.samples.size() < 2) throw InputError(reason.empty() ? "no points" : reason);
  if (found < 0.9 * all)
    flight.incomplete = reason.empty()
                            ? "the trajectory is not determined for more than a tenth of the points"
                            : reason;
}

/// Files whose times are not used have no part in a trajectory: where all are such, it has none.
void checkTimes(const SurveyReader& survey, ProgressReport& progress) {
  std::vector<std::string> faults;
  for (const SurveyedFile& file : survey.files()) {
    const PointFileInfo& info = file.sources.info;
    if (!info.time_fault.empty()) faults.push_back(info.path.string() + ": " + info.time_fault);
  }
  if (!faults.empty() && faults.size() == survey.files().size()) throw InputError(faults.front());
  for (const std::string& text : faults) progress.remark("warning: " + text);
}

}  // namespace

ReconstructedTrajectory reconstructTrajectory(SurveyReader& survey,
                                              const ReconstructionOptions& options,
                                              const ProgressCallback& callback) {
  const UnchangedInputs unchanged;
  ProgressReport progress(callback);
  const ReadingProgress reading(survey, progress);
  StripChoice strips = options.strips;
  strips.divide_lines = true;
  for (const std::string& text : survey.choose(strips, {nullptr, std::nullopt, false}))
    progress.remark(text);
  checkTimes(survey, progress);
  TrajectoryReconstruction reconstruction(options.settings);
  progress.begin("Collecting rays and scan angles");
  readPoints(survey, options.observer, reconstruction);
  progress.end(counted(survey.strips().size(), "strip"));
  progress.begin("Reconstructing the trajectory");
  ReconstructedTrajectory flight;
  flight.paths = reconstruction.reconstruct();
  joinSamples(flight);
  progress.end(grouped(flight.samples.size()) + " samples");
  collectFindings(flight, progress);
  if (options.attitude) detail::recoverAttitude(survey, flight, progress);
  for (const Warning& warning : flight.warnings) progress.remark("warning: " + warning.text);
  return flight;
}

LoadedTrajectory reconstructTrajectory(const std::vector<std::string>& points,
                                       const TrajectoryLoadingOptions& options, int threads,
                                       const ProgressCallback& progress) {
  if (points.empty())
    throw UsageError(
        "a job on a single file cannot reconstruct the trajectory: write that of all strips with "
        "pcl_als_trajectory first");
  ReconstructionOptions how;
  how.attitude = options.attitude != AttitudeUse::ignore;
  SurveyReader survey(points, threads);
  return reconstructTrajectory(survey, how, progress).asFile(options);
}

LoadedTrajectory ReconstructedTrajectory::asFile(const TrajectoryLoadingOptions& options) const {
  TrajectoryFile file;
  file.samples = samples;
  file.format = kReconstructedFormat;
  file.frame = "coordinates of the points";
  file.accuracy = accuracy;
  return flightOf(std::move(file), "the reconstructed trajectory", options);
}

std::vector<std::filesystem::path> writeReconstruction(const ReconstructedTrajectory& flight,
                                                       const std::filesystem::path& output,
                                                       const std::string& crs) {
  return writeTrajectoryFile(output, flight.samples, flight.accuracy, crs, true);
}

}  // namespace pcl_als
