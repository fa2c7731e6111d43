// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <limits>
#include <optional>
#include <set>

#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/atomic_file.h>
#include <pcl_als/io/class_io.h>
#include <pcl_als/io/crs.h>
#include <pcl_als/processing/class_maps.h>
#include <pcl_als/processing/class_model_file.h>
#include <pcl_als/processing/land_cover.h>
#include <pcl_als/processing/point_classes.h>
#include <pcl_als/processing/strip_rasters.h>
#include <pcl_als/report/accuracy_report.h>
#include <pcl_als/report/land_cover_picture.h>

#include "classify_options.h"
#include "output_check.h"
#include "strip_options.h"

namespace pcl_als::app {
namespace {

namespace fs = std::filesystem;

std::string percent(std::uint64_t part, std::uint64_t whole) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f %%",
                whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole));
  return text;
}

std::string describe(const char* name, const CellCounts& counts) {
  return std::string("  ") + name + ": " + percent(counts.measured, counts.cells()) +
         " of the cells measured, " + percent(counts.interpolated, counts.cells()) +
         " interpolated, " + percent(counts.empty, counts.cells()) + " without a value\n";
}

/// The run of the tool: what its steps share.
class Classification {
 public:
  explicit Classification(const CommandLine& line)
      : line_(line),
        surface_(surfaceOptionsOf(line)),
        bands_(bandsOf(line)),
        priors_(priorsOf(line)),
        files_(rasterInput(line.inputs(1, std::numeric_limits<std::size_t>::max()))) {
    checkOptions();
    if (line.has("crs")) requireProjectedCrs(line.text("crs"), "option -crs");
    if (choosesStrips(line)) {
      StripChoice choice = stripChoice(line);
      choice.keep_timeless = true;  // nothing here needs times
      chooseStrips(choice, files_);
    }
    remarks_ = files_.remarks;
    for (const std::string& part : describe(files_.left_out)) remarks_.push_back(part);
    const std::string crs = line.has("crs") ? line.text("crs") : files_.crs;
    grid_ = gridOf(line, files_.min_x, files_.min_y, files_.max_x, files_.max_y, crs);
    readSites();
  }

  int run() {
    makeRasters();
    if (line_.has("output")) mapClasses();
    for (const std::string& remark : remarks_) say("note: " + remark + "\n");
    if (rank_deficient_.empty()) return kDone;
    std::cerr << "pcl_als_classify: no reliable answer: too few training samples for "
              << joined(rank_deficient_) << std::endl;
    return kNoReliableAnswer;
  }

 private:
  void mapClasses() {
    BandReader bands(raster_path_, bands_);
    const MaximumLikelihood classifier(model(bands), line_.number("reject", 0.0, 0.5, ""));
    classify(classifier, bands);
    if (!checks_.empty()) assess(classifier, bands);
    if (line_.has("map")) draw();
    if (line_.has("points")) classifyPoints(classifier);
  }

  void say(const std::string& text) const {
    if (!line_.quiet()) std::cout << text << std::flush;
  }

  void checkOptions() const {
    if (!line_.has("output") && !line_.has("grids"))
      throw UsageError("option -output is needed (see pcl_als_classify -h)");
    if (line_.has("output") && line_.has("training") == line_.has("model"))
      throw UsageError("one of the options -training and -model is needed");
    for (const char* name : {"posterior", "accuracy", "checked", "save_model", "map", "points"})
      if (line_.has(name) && !line_.has("output"))
        throw UsageError(std::string("option -") + name + " needs -output");
    for (const char* name : {"accuracy", "checked"})
      if (line_.has(name) && !line_.has("checkpoints"))
        throw UsageError(std::string("option -") + name + " needs -checkpoints");
    if (line_.has("beside") && !line_.has("map")) throw UsageError("option -beside needs -map");
    // What is wrong is told before the long work, not after it.
    if (line_.has("beside")) requireClassMap(line_.text("beside"));
    line_.number("reject", 0.0, 0.5, "(probability)");
    line_.number("training_radius", 0.0, 1000.0, "m");
    line_.number("tile", 64, 8192, "cells");
    checkOutputs();
  }

  void checkOutputs() const {
    std::set<fs::path> outputs;
    const auto checkOutput = [&](const char* name, const fs::path& path) {
      if (!outputs.insert(fs::weakly_canonical(path)).second)
        throw UsageError("option -" + std::string(name) + ": " + path.string() +
                         " is also another output");
    };
    for (const char* name :
         {"output", "grids", "posterior", "accuracy", "checked", "save_model", "map"}) {
      if (!line_.has(name)) continue;
      if (!fs::is_directory(fs::absolute(line_.text(name)).parent_path()))
        throw InputError(line_.text(name) + ": cannot be created: the folder does not exist");
      checkOutput(name, line_.text(name));
    }
    if (!line_.has("points")) return;
    for (const fs::path& path : files_.paths) {
      const fs::path output = fs::path(line_.text("points")) / path.filename();
      refuseInput("points", output, files_.paths);
      checkOutput("points", output);
    }
    makeOutputFolder("points", line_.text("points"));
  }

  void readSites() {
    const LengthUnit unit = unitOption(line_, "sites");
    if (line_.has("training")) training_ = readClassSites(line_.text("training"), unit);
    if (line_.has("checkpoints")) checks_ = readClassSites(line_.text("checkpoints"), unit);
    for (const std::vector<ClassSite>* sites : {&training_, &checks_})
      for (const ClassSite& site : *sites)
        if (site.name == kUnclassified)
          throw InputError(line_.text(sites == &training_ ? "training" : "checkpoints") +
                           ": a class is named 'unclassified', which means cells without a class; "
                           "rename it");
    if (line_.has("model")) {
      given_model_ = readClassModel(line_.text("model"));
      bands_ = given_model_->bands;
      for (const std::string& band : bands_) {
        const auto& known = SurfaceAccumulator::bandNames();
        if (std::find(known.begin(), known.end(), band) == known.end())
          throw InputError(line_.text("model") + ": has a band '" + band + "' that no raster has");
      }
    }
  }

  void makeRasters() {
    RasterOptions options;
    if (line_.has("grids")) {
      raster_path_ = line_.text("grids");
    } else {
      // Beside the output, where there is room for it; it goes when the run ends, however it does.
      scratch_.emplace(line_.text("output"));
      raster_path_ = scratch_->temporaryPath();
      options.named = line_.text("output");
      options.overviews = options.cloud_optimised = options.compress = false;
    }
    options.threads = line_.threads();
    RasterLayout layout;
    layout.grid = grid_;
    layout.bands = SurfaceAccumulator::bandNames();
    Step progress("Rasters of " + grouped(grid_.columns) + " x " + grouped(grid_.rows) + " cells",
                  line_.quiet());
    RasterWriter writer(raster_path_, layout, options);
    const int tile = static_cast<int>(line_.number("tile", 64, 8192, "cells"));
    const RasterCounts counts =
        rasterizeStrips(files_, surface_, tile, line_.threads(), writer,
                        [&](double fraction) { progress.progress(fraction); });
    if (counts.points == 0)
      throw InputError(files_.paths.front().string() +
                       ": no point lies in the rasters; see -extent");
    if (counts.terrain.measured == 0) withoutTerrain();
    writer.commit();
    progress.done(grouped(counts.points) + " of " + grouped(files_.points) + " points");
    say(describe("surface", counts.surface) + describe("terrain", counts.terrain));
  }

  /// Not fatal where nobody asks for heights above it.
  void withoutTerrain() {
    const auto wanted = [&](const char* band) {
      return std::find(bands_.begin(), bands_.end(), band) != bands_.end();
    };
    const std::string what = "no ground points; see -ground and -ground_classes";
    if (line_.has("points") || (line_.has("output") && (wanted("height") || wanted("terrain"))))
      throw InputError(files_.paths.front().string() + ": " + what);
    remarks_.push_back(what);
  }

  GaussianModel model(BandReader& bands) {
    GaussianModel result;
    if (given_model_) {
      result = *given_model_;
    } else {
      const TrainingReport collected =
          collectTraining(training_, line_.number("training_radius", 0.0, 1000.0, "m"), bands);
      addRemarks(collected.remarks);
      try {
        TrainingResult trained = trainGaussianModel(bands_, collected.classes);
        addRemarks(trained.remarks);
        result = std::move(trained.model);
      } catch (const UsageError& error) {
        std::string message = line_.text("training") + ": " + error.what();
        for (const std::string& remark : remarks_) message += "; " + remark;
        throw InputError(message);
      }
    }
    if (!priors_.empty()) setPriors(priors_, result);
    for (const GaussianClass& c : result.classes) {
      if (c.samples > bands_.size()) continue;
      rank_deficient_.push_back("class " + c.name);
      remarks_.push_back("class " + c.name + ": " + counted(c.samples, "sample") +
                         (c.samples == 1 ? " determines" : " determine") + " no covariance of " +
                         std::to_string(bands_.size()) +
                         " bands: its cells are not reliable (exit status 3)");
    }
    if (line_.has("save_model")) writeClassModel(line_.text("save_model"), result, remarks_);
    return result;
  }

  void classify(const MaximumLikelihood& classifier, BandReader& bands) {
    RasterLayout layout;
    layout.grid = bands.grid();
    layout.type = RasterLayout::Type::byte;
    layout.bands = {"class"};
    layout.legend = legendOf(classifier.model());
    RasterOptions options;
    options.threads = line_.threads();
    Step progress("Classifying by " + joined(bands_), line_.quiet());
    RasterWriter map(line_.text("output"), layout, options);
    std::optional<RasterWriter> posterior;
    if (line_.has("posterior")) {
      RasterLayout probability;
      probability.grid = layout.grid;
      probability.bands = {"posterior"};
      posterior.emplace(line_.text("posterior"), probability, options);
    }
    const CoverCounts counts =
        classifyCells(classifier, bands, line_.threads(), map, posterior ? &*posterior : nullptr,
                      [&](double fraction) { progress.progress(fraction); });
    if (posterior) posterior->commit();
    map.commit();
    progress.done(grouped(grid_.cells()) + " cells");
    for (std::size_t i = 0; i < counts.cells.size(); ++i)
      say("  " + classifier.model().classes[i].name + ": " +
          percent(counts.cells[i], grid_.cells()) + "\n");
    say("  no class: " + percent(counts.rejected, grid_.cells()) + " rejected, " +
        percent(counts.without_values, grid_.cells()) + " without values\n");
  }

  void assess(const MaximumLikelihood& classifier, BandReader& bands) {
    CheckReport checked = collectChecks(checks_, classifier, bands);
    if (checked.sites.empty()) {
      throw InputError(line_.text("checkpoints") +
                       ": no check site lies in the rasters; see -extent");
    }
    std::vector<std::string> names;
    for (const GaussianClass& c : classifier.model().classes) names.push_back(c.name);
    const CountedSites counted = countSites(checked.sites, names);
    AccuracyReport report{countPoints(counted.classes, counted.points),
                          assessSites(counted),
                          {},
                          {},
                          {},
                          {},
                          checked.remarks,
                          files_.left_out};
    report.inputs = {line_.text("checkpoints"), line_.text("output")};
    say("\n" + accuracyText(report));
    if (line_.has("accuracy")) writeAccuracy(line_.text("accuracy"), report);
    if (line_.has("checked")) writeCheckedSites(line_.text("checked"), checked.sites);
  }

  void draw() const {
    std::vector<std::string> captions{"before", "after"};
    if (line_.has("captions")) captions = splitList(line_.text("captions"));
    captions.resize(2);
    std::vector<TitledMap> maps;
    if (line_.has("beside")) maps.push_back({captions[0], line_.text("beside")});
    const std::string own = line_.has("beside") ? captions[1] : "land cover";
    maps.push_back({own, line_.text("output")});
    drawMaps(line_.text("map"), maps);
  }

  void classifyPoints(const MaximumLikelihood& classifier) const {
    const fs::path folder = line_.text("points");
    PointClasses classes(std::make_shared<const MaximumLikelihood>(classifier), raster_path_);
    for (std::size_t place = 0; place < files_.paths.size(); ++place) {
      const fs::path& path = files_.paths[place];
      Step progress("Classifying the points of " + path.filename().string(), line_.quiet());
      const PointClassCounts counts = classifyPointFile(
          path, folder / path.filename(), classes, files_.arranged.get(), place, line_.threads());
      progress.done(grouped(counts.points) + " points, " + grouped(counts.unclassified) +
                    " without a class");
    }
  }

  void addRemarks(const std::vector<std::string>& remarks) {
    remarks_.insert(remarks_.end(), remarks.begin(), remarks.end());
  }
  static std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
  }

  const CommandLine& line_;
  SurfaceOptions surface_;
  std::vector<std::string> bands_;
  std::vector<std::pair<std::string, double>> priors_;
  RasterInput files_;
  RasterGrid grid_;
  std::vector<ClassSite> training_, checks_;
  std::optional<GaussianModel> given_model_;
  std::optional<AtomicFile> scratch_;
  fs::path raster_path_;
  std::vector<std::string> remarks_;
  std::vector<std::string> rank_deficient_;  ///< "class road", …
};

int classify(int argc, char** argv) {
  CommandLine line = declareClassify();
  if (!line.parse(argc, argv)) return kDone;
  return Classification(line).run();
}

}  // namespace
}  // namespace pcl_als::app

int main(int argc, char** argv) {
  return pcl_als::app::run("pcl_als_classify", [&] { return pcl_als::app::classify(argc, argv); });
}
