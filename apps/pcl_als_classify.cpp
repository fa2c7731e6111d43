// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>
#include <optional>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/class_io.h>
#include <pcl_als/processing/class_maps.h>
#include <pcl_als/processing/class_model_file.h>
#include <pcl_als/processing/land_cover_job.h>
#include <pcl_als/report/accuracy_report.h>
#include <pcl_als/report/land_cover_picture.h>

#include "classify_options.h"
#include "processes.h"
#include "strip_options.h"

namespace pcl_als::app {
namespace {

namespace fs = std::filesystem;

/// What is wrong is told before the long work, not after it.
void checkOptions(const CommandLine& line) {
  if (!line.has("output") && !line.has("grids"))
    throw UsageError("one of the options -output and -grids is needed (see pcl_als_classify -h)");
  if (line.has("output") && line.has("training") == line.has("class_model"))
    throw UsageError("one of the options -training and -class_model is needed");
  if (line.has("beside")) requireClassMap(line.text("beside"));
}

std::vector<ClassSite> sitesOf(const CommandLine& line, const std::string& option) {
  if (!line.has(option)) return {};
  std::vector<ClassSite> sites = readClassSites(line.text(option), unitOption(line, "sites"));
  for (const ClassSite& site : sites) {
    if (site.name == kUnclassified)
      throw InputError(line.text(option) +
                       ": a class is named 'unclassified', which means cells without a class; "
                       "rename it");
  }
  return sites;
}

fs::path pathOf(const CommandLine& line, const std::string& option) {
  return line.has(option) ? fs::path(line.text(option)) : fs::path();
}

RasterInput inputOf(const CommandLine& line) {
  RasterInput files = rasterInput(line.inputs(), line.threads(), processes());
  if (!choosesStrips(line)) return files;
  StripChoice choice = stripChoice(line);
  choice.keep_timeless = true;  // nothing here needs times
  chooseStrips(choice, files, line.threads());
  return files;
}

LandCoverOptions optionsOf(const CommandLine& line, const RasterInput& files) {
  LandCoverOptions options;
  options.surface = surfaceOptionsOf(line);
  options.bands = line.parsed("bands", bandsIn);
  if (line.has("priors")) options.priors = line.parsed("priors", priorsIn);
  if (line.has("crs")) requireProjectedCrs(line.text("crs"), "option -crs");
  options.grid = gridOf(line, files.min_x, files.min_y, files.max_x, files.max_y,
                        line.has("crs") ? line.text("crs") : files.crs);
  options.training = sitesOf(line, "training");
  options.checks = sitesOf(line, "checkpoints");
  if (line.has("class_model")) options.model = readClassModel(line.text("class_model"));
  if (line.has("training")) options.training_name = line.text("training");
  if (line.has("checkpoints")) options.checks_name = line.text("checkpoints");
  options.reject = line.number("reject");
  options.training_radius = line.number("training_radius");
  options.tile = static_cast<int>(line.whole("tile"));
  options.threads = line.threads();
  options.map = pathOf(line, "output");
  options.grids = pathOf(line, "grids");
  options.posterior = pathOf(line, "posterior");
  options.points = pathOf(line, "classified");
  options.batch = batchOptions(line);
  return options;
}

void assess(const CommandLine& line, const LandCoverResult& result, const RasterInput& files) {
  std::vector<std::string> names;
  for (const GaussianClass& c : result.model->classes) names.push_back(c.name);
  const CountedSites counted = countSites(result.checks.sites, names);
  AccuracyReport report{countPoints(counted.classes, counted.points),
                        assessSites(counted),
                        {},
                        {},
                        {},
                        {},
                        result.checks.remarks,
                        files.excluded};
  report.inputs = {line.text("checkpoints"), line.text("output")};
  if (!line.quiet()) std::cout << '\n' << accuracyText(report) << std::flush;
  if (line.has("accuracy")) writeFile(line.text("accuracy"), accuracyJson(report));
  if (line.has("checked")) writeCheckedSites(line.text("checked"), result.checks.sites);
}

void draw(const CommandLine& line) {
  std::vector<std::string> captions{"before", "after"};
  if (line.has("captions")) captions = splitList(line.text("captions"));
  captions.resize(2);
  std::vector<TitledMap> maps;
  if (line.has("beside")) maps.push_back({captions[0], line.text("beside")});
  const std::string own = line.has("beside") ? captions[1] : "land cover";
  maps.push_back({own, line.text("output")});
  drawMaps(line.text("map"), maps);
}

int classify(const CommandLine& line) {
  checkOptions(line);
  const RasterInput files = inputOf(line);
  const LandCoverResult result = classifyLandCover(files, optionsOf(line, files), progressOf(line));
  if (!isRoot(processes())) return kDone;
  std::vector<std::string> notes = files.remarks;
  for (const std::string& part : describe(files.excluded)) notes.push_back(part);
  notes.insert(notes.end(), result.remarks.begin(), result.remarks.end());
  if (line.has("save_class_model"))
    writeClassModel(line.text("save_class_model"), *result.model, notes);
  if (!result.checks.sites.empty()) assess(line, result, files);
  if (line.has("map")) draw(line);
  if (!line.quiet()) {
    for (const std::string& note : notes) std::cout << "note: " << note << '\n';
  }
  const std::string few = joined(result.undetermined);
  return conclude(line, few.empty() ? "" : "too few training samples for " + few);
}

}  // namespace
}  // namespace pcl_als::app

int main(int argc, char** argv) {
  return pcl_als::app::runShared(argc, argv, pcl_als::app::declareClassify, pcl_als::app::classify);
}
