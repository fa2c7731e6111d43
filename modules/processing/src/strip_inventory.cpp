// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/strip_inventory.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {
namespace {

LoadedTrajectory inventoryTrajectory(const InventoryRequest& request, const SurveyReader& survey) {
  TrajectoryLoadingOptions options;
  static_cast<TrajectoryReading&>(options) = request.reading;
  if (options.crs.empty()) options.crs = survey.reference().crs;
  return loadTrajectory(request.trajectory, options);
}

/// The points with their strips by the trajectory; empty where they do not belong together.
std::optional<SurveyReader> withTrajectory(const InventoryRequest& request,
                                           LoadedTrajectory& flight,
                                           std::vector<std::string>& notes) {
  if (request.trajectory.empty()) return std::nullopt;
  std::vector<std::string> paths;
  for (const std::filesystem::path& file : request.files) paths.push_back(file.string());
  try {
    SurveyReader survey(paths, request.threads, request.window);
    flight = inventoryTrajectory(request, survey);
    notes = survey.choose(request.strips, {flight.trajectory.get(), std::nullopt, false});
    return survey;
  } catch (const InputError& error) {
    notes = {std::string("strips are divided without the trajectory: ") + error.what()};
    return std::nullopt;
  }
}

}  // namespace

StripInventoryResult takeInventory(const InventoryRequest& request,
                                   const std::function<void(double)>& progress) {
  StripInventoryResult result;
  LoadedTrajectory flight;
  std::optional<SurveyReader> survey = withTrajectory(request, flight, result.notes);
  if (!survey) {
    survey.emplace(SurveyReader::ofFiles(request.files, request.threads, request.window));
    survey->choose(request.strips, {});
  }
  std::vector<PointFileInfo> measured;
  for (const SurveyedFile& file : survey->files()) measured.push_back(file.sources.info);
  std::vector<std::uint64_t> counts(survey->arrangement().labels().size());
  InventoryStrips strips;
  strips.names = survey->arrangement().names();
  strips.run = [&](std::size_t file, const PointChunk& chunk, std::size_t from) {
    const SurveyReader::Run run = survey->runAt(file, chunk, from);
    counts[run.label] += run.to - from;
    return std::pair(run.to, run.strip);
  };
  result.inventory =
      takeInventory(request.files, request.cell > 0.0 ? request.cell : usualInventoryCell(measured),
                    progress, strips, request.window);
  result.excluded = survey->arrangement().excludedPoints(counts);
  return result;
}

}  // namespace pcl_als
