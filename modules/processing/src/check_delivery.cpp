// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/point_files.h>
#include <pcl_als/processing/check_delivery.h>
#include <pcl_als/processing/delivery_checker.h>
#include <pcl_als/quality/accuracy_standards.h>
#include <pcl_als/quality/swath_separation.h>
#include <pcl_als/survey/surveyed_file.h>

#include "separation_image.h"

namespace pcl_als {
namespace {

/// The grid of the images; null where none are requested or no strips overlap.
std::unique_ptr<SwathSeparation> separationOf(const SurveyReader& survey,
                                              const DeliveryChecker& check,
                                              const DeliveryCheckOptions& options,
                                              ProgressReport& progress) {
  if (!options.separation || check.overlaps().empty()) return nullptr;
  const SeparationImageOptions& wanted = *options.separation;
  const auto level = static_cast<std::size_t>(wanted.quality_level);
  const double cell =
      wanted.cell > 0.0 ? wanted.cell : qualityLevels()[level].separation_image_cell;
  RasterGrid grid =
      separationGrid(survey.extent(), check.coveredArea(), cell, survey.reference().crs);
  if (grid.cell > cell) {
    progress.remark("so large a block gets a swath separation image of " +
                    std::to_string(static_cast<int>(grid.cell)) + " m cells");
  }
  return std::make_unique<SwathSeparation>(std::move(grid), survey.strips().size());
}

std::vector<ExcludedPoints> chooseAreas(DeliveryChecker& check, const DeliveryCheckOptions& options,
                                        ProgressReport& progress) {
  progress.begin("Surveying the block");
  std::vector<ExcludedPoints> excluded = check.surveyBlock();
  if (options.areas.empty()) {
    check.chooseAreas();
  } else {
    check.setAreas(options.areas);
  }
  progress.end(counted(check.overlaps().size(), "overlapping pair") + ", " +
               counted(check.areas().size(), "area"));
  return excluded;
}

void loadAreas(DeliveryChecker& check, const SurveyReader& survey, const SurveyObserver& observer,
               SwathSeparation* separation, ProgressReport& progress) {
  progress.begin("Reading the areas");
  if (observer.begin) observer.begin(survey);
  if (separation != nullptr || observer.points) {
    check.load([&](int strip, const LidarReturn& point) {
      if (separation != nullptr) separation->add(strip, point);
      if (observer.points) observer.points(strip, &point, 1);
    });
  } else {
    check.load({});
  }
  progress.end(grouped(check.loadedPoints()) + " points");
}

void writeImages(const SeparationImageOptions& wanted, const SwathSeparation& separation,
                 int threads, CheckedBlock& block, ProgressReport& progress) {
  progress.begin("Writing " + wanted.name);
  block.separation =
      writeSeparation(wanted.folder, wanted.name, separation, wanted.quality_level, threads);
  progress.end(std::to_string(separation.grid().columns) + " x " +
               std::to_string(separation.grid().rows) + " cells");
}

}  // namespace

DeliveryCheckResult checkDelivery(SurveyReader& survey,
                                  const std::shared_ptr<const Trajectory>& trajectory,
                                  const DeliveryCheckOptions& options,
                                  const ProgressCallback& callback) {
  if (options.separation && (options.separation->quality_level < 0 ||
                             options.separation->quality_level >= kQualityLevels)) {
    throw UsageError("check: the quality level must be 0, 1, 2 or 3");
  }
  const UnchangedInputs unchanged;
  ProgressReport progress(sharedProgress(survey.processes(), callback));
  const ReadingProgress reading(survey, progress);
  StripChoice strips = options.strips;
  strips.divide_lines = true;
  // The trajectory serves for scan angles only: points that it does not cover are compared, too.
  for (const std::string& text :
       survey.choose(strips, {trajectory.get(), options.gps_week, false})) {
    progress.remark(text);
  }
  DeliveryChecker check(survey, options.settings, trajectory);
  const std::vector<ExcludedPoints> excluded = chooseAreas(check, options, progress);
  const auto separation = separationOf(survey, check, options, progress);
  loadAreas(check, survey, options.observer, separation.get(), progress);
  progress.begin("Measuring");
  DeliveryCheckResult checked;
  checked.block = check.assess([&](double fraction) { progress.advance(fraction); });
  for (const SurveyedFile& file : survey.files()) {
    checked.block.files.push_back(file.sources.info.path.string());
    if (!file.sources.damage.empty()) checked.block.warnings.push_back(file.sources.damage);
  }
  for (const ExcludedPoints& part : excluded) {
    checked.block.excluded.push_back(part);
    checked.block.warnings.push_back(describe(part));
  }
  progress.end(counted(checked.block.pairs.size(), "pair"));
  if (separation && isRoot(survey.processes())) {
    writeImages(*options.separation, *separation, options.settings.threads, checked.block,
                progress);
  }
  checked.areas = check.areas();
  checked.crs = survey.reference().crs;
  return checked;
}

std::vector<std::string> filesLike(const std::vector<std::string>& others,
                                   const std::vector<std::string>& given) {
  namespace fs = std::filesystem;
  std::vector<std::string> files = given;
  if (given.size() == 1 && fs::is_directory(given.front())) {
    files = pointFilesIn(given.front());
    if (files.empty()) throw InputError(given.front() + " holds no point files");
  }
  if (files.empty()) throw InputError("no point files to compare with");
  const auto place = [&](const std::string& file) {
    return std::find_if(others.begin(), others.end(), [&](const std::string& other) {
      return fs::path(other).filename() == fs::path(file).filename();
    });
  };
  std::stable_sort(files.begin(), files.end(),
                   [&](const std::string& a, const std::string& b) { return place(a) < place(b); });
  return files;
}

}  // namespace pcl_als
