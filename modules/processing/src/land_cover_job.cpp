// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_protection.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/processing/file_batch.h>
#include <pcl_als/processing/land_cover.h>
#include <pcl_als/processing/land_cover_job.h>
#include <pcl_als/processing/point_classes.h>

#include "strip_rasters.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

std::string percent(std::uint64_t part, std::uint64_t whole) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f %%",
                whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole));
  return text;
}

std::string describe(const char* name, const CellCounts& counts) {
  return std::string(name) + ": " + percent(counts.measured, counts.cells()) +
         " of the cells measured, " + percent(counts.interpolated, counts.cells()) +
         " interpolated, " + percent(counts.empty, counts.cells()) + " without a value";
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The job: what its phases share.
class LandCover {
 public:
  LandCover(const RasterInput& files, const LandCoverOptions& options, ProgressReport& progress)
      : files_(files), options_(options), progress_(progress), bands_(options.bands) {
    if (options.model) bands_ = options.model->bands;
    for (const std::string& band : bands_) requireBand(band);
    result_.grid = options.grid ? *options.grid
                                : RasterGrid::covering(files.min_x, files.min_y, files.max_x,
                                                       files.max_y, options.cell, files.crs);
  }

  LandCoverResult run() {
    makeRasters();
    if (!options_.map.empty()) {
      BandReader bands(raster_path_, bands_);
      const MaximumLikelihood classifier(model(bands), options_.reject);
      classify(classifier, bands);
      if (!options_.checks.empty()) check(classifier, bands);
      if (!options_.points.empty()) classifyPoints(classifier);
    }
    doTogether(options_.batch.processes, [] {});  // before the first one removes the rasters
    return std::move(result_);
  }

 private:
  void choosePath();
  void makeRasters();
  void requireTerrain();
  GaussianModel model(BandReader& bands);
  GaussianModel trained(BandReader& bands);
  void classify(const MaximumLikelihood& classifier, BandReader& bands);
  void writeMap(const MaximumLikelihood& classifier, BandReader& bands);
  void reportCover(const GaussianModel& model);
  void check(const MaximumLikelihood& classifier, BandReader& bands);
  void classifyPoints(const MaximumLikelihood& classifier);
  void addRemarks(const std::vector<std::string>& remarks) {
    result_.remarks.insert(result_.remarks.end(), remarks.begin(), remarks.end());
  }

  const RasterInput& files_;
  const LandCoverOptions& options_;
  ProgressReport& progress_;
  std::vector<std::string> bands_;
  std::optional<AtomicFile> scratch_;
  fs::path raster_path_;
  LandCoverResult result_;
};

/// The file of the rasters; one that is not kept is beside the output, where there is space for
/// it, and removed when the job ends in any way.
void LandCover::choosePath() {
  Communicator* const processes = options_.batch.processes;
  raster_path_ = options_.grids;
  if (!options_.grids.empty()) return;
  if (isRoot(processes)) {
    scratch_.emplace(options_.map);
    raster_path_ = scratch_->temporaryPath();
  }
  if (areShared(processes)) raster_path_ = processes->gatherAll(raster_path_.string()).front();
}

void LandCover::makeRasters() {
  Communicator* const processes = options_.batch.processes;
  doTogether(processes, [] {});
  choosePath();
  RasterOptions options;
  if (options_.grids.empty()) {
    options.named = options_.map;
    options.overviews = options.cloud_optimised = options.compress = false;
  }
  options.threads = options_.threads;
  RasterLayout layout;
  layout.grid = result_.grid;
  layout.bands = SurfaceAccumulator::bandNames();
  progress_.begin("Rasters of " + grouped(result_.grid.columns) + " x " +
                  grouped(result_.grid.rows) + " cells");
  std::optional<RasterWriter> writer;
  doTogether(processes, [&] {
    if (isRoot(processes)) writer.emplace(raster_path_, layout, options);
  });
  result_.rasters = rasterizeStrips(
      files_, result_.grid, options_.surface, options_.tile, options_.threads,
      writer ? &*writer : nullptr, [&](double fraction) { progress_.advance(fraction); },
      processes);
  if (result_.rasters.points == 0) {
    throw InputError(files_.paths.front().string() + ": no point lies in the rasters",
                     Hint::extent);
  }
  if (result_.rasters.terrain.measured == 0) requireTerrain();
  if (result_.rasters.echo_widths == 0 && !options_.map.empty() && holds(bands_, "echo_width")) {
    throw InputError(files_.paths.front().string() +
                     ": no point has the extra bytes echo_width, from which the band echo_width is "
                     "made; decompose the waveforms by pcl_als_waveform, or leave the band out");
  }
  doTogether(processes, [&] {
    if (writer) writer->commit();
  });
  progress_.end(grouped(result_.rasters.points) + " of " + grouped(files_.points) + " points");
  progress_.remark(describe("surface", result_.rasters.surface));
  progress_.remark(describe("terrain", result_.rasters.terrain));
}

/// Rasters without ground points: not fatal where nobody asks for heights above them.
void LandCover::requireTerrain() {
  const bool classified = !options_.map.empty();
  if (!options_.points.empty() ||
      (classified && (holds(bands_, "height") || holds(bands_, "terrain")))) {
    throw InputError(files_.paths.front().string() + ": no ground points", Hint::ground);
  }
  result_.remarks.emplace_back("no ground points: the terrain and heights above it are empty");
}

GaussianModel LandCover::trained(BandReader& bands) {
  const TrainingReport collected =
      collectTraining(options_.training, options_.training_radius, bands);
  addRemarks(collected.remarks);
  try {
    TrainingResult trained = trainGaussianModel(bands_, collected.classes);
    addRemarks(trained.remarks);
    return std::move(trained.model);
  } catch (const UsageError& error) {
    std::string message = options_.training_name + ": " + error.what();
    for (const std::string& remark : result_.remarks) message += "; " + remark;
    throw InputError(message);
  }
}

GaussianModel LandCover::model(BandReader& bands) {
  GaussianModel model = options_.model ? *options_.model : trained(bands);
  if (!options_.priors.empty()) setPriors(options_.priors, model);
  for (const GaussianClass& c : model.classes) {
    if (c.samples > bands_.size()) continue;
    result_.undetermined.push_back("class " + c.name);
    result_.remarks.push_back("class " + c.name + ": " + counted(c.samples, "sample") +
                              (c.samples == 1 ? " determines" : " determine") +
                              " no covariance of " + std::to_string(bands_.size()) +
                              " bands: its cells are not reliable (exit status 3)");
  }
  result_.model = model;
  return model;
}

/// The map, by the first process: it takes less time than the sending of its parts would.
void LandCover::writeMap(const MaximumLikelihood& classifier, BandReader& bands) {
  RasterLayout layout;
  layout.grid = bands.grid();
  layout.type = RasterLayout::Type::byte;
  layout.bands = {"class"};
  layout.legend = legendOf(classifier.model());
  RasterOptions options;
  options.threads = options_.threads;
  RasterWriter map(options_.map, layout, options);
  std::optional<RasterWriter> posterior;
  if (!options_.posterior.empty()) {
    RasterLayout probability;
    probability.grid = layout.grid;
    probability.bands = {"posterior"};
    posterior.emplace(options_.posterior, probability, options);
  }
  result_.cover =
      classifyCells(classifier, bands, options_.threads, map, posterior ? &*posterior : nullptr,
                    [&](double fraction) { progress_.advance(fraction); });
  if (posterior) posterior->commit();
  map.commit();
}

void LandCover::classify(const MaximumLikelihood& classifier, BandReader& bands) {
  Communicator* const processes = options_.batch.processes;
  std::string names;
  for (const std::string& band : bands_) names += (names.empty() ? "" : ", ") + band;
  progress_.begin("Classifying by " + names);
  doTogether(processes, [&] {
    if (isRoot(processes)) writeMap(classifier, bands);
  });
  if (areShared(processes)) {
    CoverCounts& cover = result_.cover;
    const ByteWriter own =
        ByteWriter().put(cover.cells).put(cover.rejected).put(cover.without_values);
    const std::string of_root = processes->gatherAll(own.bytes()).front();
    ByteReader(of_root).get(cover.cells).get(cover.rejected).get(cover.without_values);
  }
  progress_.end(grouped(result_.grid.cells()) + " cells");
  reportCover(classifier.model());
}

void LandCover::reportCover(const GaussianModel& model) {
  const std::uint64_t cells = result_.grid.cells();
  for (std::size_t i = 0; i < result_.cover.cells.size(); ++i)
    progress_.remark(model.classes[i].name + ": " + percent(result_.cover.cells[i], cells));
  progress_.remark("no class: " + percent(result_.cover.rejected, cells) + " rejected, " +
                   percent(result_.cover.without_values, cells) + " without values");
}

void LandCover::check(const MaximumLikelihood& classifier, BandReader& bands) {
  result_.checks = collectChecks(options_.checks, classifier, bands);
  if (result_.checks.sites.empty()) {
    throw InputError(options_.checks_name + ": no check site lies in the rasters", Hint::extent);
  }
}

void LandCover::classifyPoints(const MaximumLikelihood& classifier) {
  PointClasses classes(std::make_shared<const MaximumLikelihood>(classifier), raster_path_);
  std::vector<std::string> inputs;
  for (const fs::path& path : files_.paths) inputs.push_back(path.string());
  BatchOptions options = options_.batch;
  options.joint = true;
  FileBatch batch(inputs, outputsIn(options_.points, inputs), options);
  progress_.begin("Classifying the points of " + counted(inputs.size(), "file"));
  const std::vector<std::string> results = batch.run(
      [&](std::size_t file, const std::function<void(double)>& fraction) {
        const PointClassCounts counts = classifyPointFile(
            inputs[file], batch.outputs()[file], classes, *files_.survey, file, options_.threads);
        fraction(1.0);
        return ByteWriter().put(counts.points).put(counts.unclassified).put(counts.remarks).take();
      },
      [this](double fraction) { progress_.advance(fraction); });
  PointClassCounts all;
  for (std::size_t file = 0; file < inputs.size(); ++file) {
    PointClassCounts counts;
    ByteReader(results[file]).get(counts.points).get(counts.unclassified).get(counts.remarks);
    all.points += counts.points;
    all.unclassified += counts.unclassified;
    for (const std::string& text : counts.remarks)
      all.remarks.push_back(inputs[file] + ": " + text);
  }
  progress_.end(grouped(all.points) + " points, " + grouped(all.unclassified) + " without a class");
  for (const std::string& text : all.remarks) progress_.remark(text);
  if (batch.keptCount() > 0)
    progress_.remark(counted(batch.keptCount(), "file") + " complete from an earlier run");
}

void checkOptions(const LandCoverOptions& options) {
  if (options.map.empty() && options.grids.empty())
    throw UsageError("classification: neither a map nor rasters are asked for");
  if (!options.map.empty() && options.training.empty() == !options.model)
    throw UsageError("classification: needs training sites or a model, and not both");
  if (options.map.empty() && (!options.posterior.empty() || !options.points.empty()))
    throw UsageError("classification: probabilities and point files come with a map");
}

}  // namespace

LandCoverResult classifyLandCover(const RasterInput& files, const LandCoverOptions& options,
                                  const ProgressCallback& callback) {
  checkOptions(options);
  const UnchangedInputs unchanged;
  FileProtection protection(files.paths);
  for (const auto& output : {options.map, options.grids, options.posterior})
    protection.check(output);
  if (!options.points.empty()) protection.guard(options.points);
  ProgressReport progress(sharedProgress(options.batch.processes, callback));
  return LandCover(files, options, progress).run();
}

}  // namespace pcl_als
