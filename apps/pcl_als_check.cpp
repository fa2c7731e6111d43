// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <iostream>
#include <memory>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/memory.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/check_delivery.h>
#include <pcl_als/processing/delivery_requirement.h>
#include <pcl_als/report/quality_layers.h>
#include <pcl_als/report/quality_page.h>
#include <pcl_als/report/quality_report.h>

#include "command_line.h"
#include "flight_options.h"
#include "hint_options.h"
#include "processes.h"
#include "report_options.h"
#include "strip_options.h"
#include "window_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;
namespace fs = std::filesystem;

CommandLine commandLine() {
  const CheckSettings defaults;
  CommandLine line(
      "pcl_als_check",
      "measures how well overlapping strips agree with each other and with control, and assesses "
      "them by the USGS Lidar Base Specification and the ASPRS standards.",
      "STRIP... [-before DIR|FILE,FILE] [-control C] [-trajectory T] -output "
      "quality.json [-report DIR]",
      "pcl_als_check corrected/strip*.las -before strips -control control.csv -output "
      "quality.json -report report");
  line.setArguments({{"", 1, app::Arguments::kAnyNumber}});
  app::addFlightOptions(line, "for scan angles that are finer than those of the files");
  app::addForceOption(line);
  line.addInputFile("before",
                    "the same strips before the correction: a folder, or files separated by "
                    "commas; both are reported side by side",
                    [](const CommandLine& given) { return app::pointFiles(given, "before"); });
  app::addWindowOptions(line);
  app::addStripOptions(line);
  app::addChannelOption(line);
  app::addControlOptions(line);
  line.addOutputFile("output", "quality.json to write", {".json"}).needed();
  app::addReportOption(
      line,
      "folder for report.html (pictures inside), tables as Markdown and CSV, swath separation "
      "images",
      {"quality.md", "pairs.csv", "slope_aspect.csv", "profiles.csv", "offsets.csv", "run.csv",
       "control.csv", "swath_separation.tif", "swath_separation_metres.tif", "swath_separation.png",
       "swath_separation_before.tif", "swath_separation_before_metres.tif",
       "swath_separation_before.png"});
  line.addOutputFile("gis",
                     "GeoPackage for geographic information systems: outlines of strips and of "
                     "overlaps with the results of pairs, offsets, control",
                     {".gpkg"});
  line.addWhole("quality_level", "quality level of the report (QL0 to QL3)", 2,
                {0, kQualityLevels - 1, {}});
  line.addChoice("require",
                 "the quality level of the report, with exit status 3 where the delivery does not "
                 "keep it: every overlapping pair has to be measured and within the limit, and so "
                 "has control where it is given",
                 {"QL0", "QL1", "QL2", "QL3"});
  line.addNumber("control_sigma", "standard deviation of control points whose file gives none",
                 defaults.control_sigma, {0.0, 10.0, "m"})
      .in(app::Group::priors);
  line.addNumber("max_distance", "larger offsets count as different objects",
                 defaults.limits.maximum_distance, {0.05, 50.0, "m"});
  line.addNumber("cell",
                 "cell size of the swath separation image; 0: as required by the quality level",
                 0.0, {0.0, 100.0, "m"})
      .in(app::Group::output);
  line.addNumber("points", "largest number of points in the areas that are compared", 12.0,
                 {0.01, 1000.0, "millions"});
  return line;
}

/// The level that is required, or else that of the report.
int levelOf(const CommandLine& line) {
  const auto level = static_cast<int>(line.whole("quality_level"));
  if (!line.has("require")) return level;
  const auto required = static_cast<int>(line.choice("require"));
  if (line.given("quality_level") && level != required)
    throw UsageError("options -require and -quality_level name different levels: give one of them");
  return required;
}

/// Where a level is required, the exit status states whether the delivery keeps it.
int concludeRequirement(const CommandLine& line, const QualityReport& report) {
  const DeliveryRequirement requirement = requireLevel(report.block, report.quality_level);
  if (!line.has("require") || requirement.kept) return app::kDone;
  std::cerr << line.tool() << ": " << requirement.describe() << std::endl;
  return app::kNoReliableAnswer;
}

CheckSettings settingsOf(const CommandLine& line) {
  CheckSettings settings;
  settings.limits.maximum_distance = line.number("max_distance");
  settings.selection.point_budget = static_cast<std::size_t>(1e6 * line.number("points"));
  settings.control_sigma = line.number("control_sigma");
  settings.force = line.has("force");
  settings.threads = line.threads();
  settings.control = app::controlOf(line);
  return settings;
}

/// The images of a report; none in a build without GDAL.
std::optional<SeparationImageOptions> separationOf(const CommandLine& line,
                                                   const std::string& name) {
  const double cell = line.number("cell");
  if (!line.has("report")) return std::nullopt;
  if (!PCL_ALS_WITH_GDAL) {
    app::remark(line, "built without GDAL: no swath separation image");
    return std::nullopt;
  }
  return SeparationImageOptions{line.text("report"), name, cell, levelOf(line)};
}

/// Checks one set of files; \a image: name of its swath separation image.
DeliveryCheckResult checkFiles(const CommandLine& line, const std::vector<std::string>& files,
                               DeliveryCheckOptions options, const std::string& image) {
  Step reading("Reading " + counted(files.size(), "point file"), line.quiet());
  SurveyReader survey(files, line.threads(), app::windowOf(line), app::processes());
  reading.done(grouped(survey.pointCount()) + " points");
  app::remarks(line, survey.reference().remarks);
  std::shared_ptr<const Trajectory> trajectory;
  if (line.has("trajectory")) {
    trajectory =
        app::loadTrajectory(line, survey.reference().crs, 0.0, AttitudeUse::where_given, files);
  }
  options.separation = separationOf(line, image);
  DeliveryCheckResult checked = checkDelivery(survey, trajectory, options, app::progressOf(line));
  app::nameOptions(line, checked.block.warnings);
  return checked;
}

void writeReport(const CommandLine& line, const QualityReport& report,
                 const std::vector<SurveyArea>& areas, const QualityPage& page) {
  const fs::path folder = line.text("report");
  Step step("Writing the report into " + folder.string(), line.quiet());
  writeQualityTables(folder, report);
  page.write(app::reportOrigin(line), report, areas);
  step.done("report.html with pictures, report.md, quality.md, CSV");
}

int check(const CommandLine& line) {
  if (line.has("gis") && !PCL_ALS_WITH_GDAL)
    throw UsageError("option -gis: built without GDAL; build with -DPCL_ALS_WITH_GDAL=ON");
  const std::vector<std::string>& files = line.inputs();
  DeliveryCheckOptions options;
  options.settings = settingsOf(line);
  options.strips = app::stripChoice(line);
  app::checkFlightOptions(line);
  options.gps_week = app::gpsWeek(line);
  QualityReport report;
  report.quality_level = levelOf(line);
  std::vector<std::string> before;
  if (line.has("before")) {
    before = filesLike(files, splitList(line.text("before")));
    refuseRepeated(before);
  }
  QualityPage page(line.has("report") || line.has("gis"));
  options.observer = page.observer();
  DeliveryCheckResult checked = checkFiles(line, files, options, "swath_separation");
  report.block = std::move(checked.block);
  if (!before.empty()) {
    options.areas = checked.areas;
    options.observer = {};
    report.before = checkFiles(line, before, options, "swath_separation_before").block;
  }
  if (!isRoot(app::processes())) return app::kDone;
  report.peak_memory_mb = peakMemory();
  writeFile(line.text("output"), qualityJson(report));
  if (!line.quiet()) std::cout << qualityText(report) << std::endl;
  if (line.has("report")) writeReport(line, report, checked.areas, page);
  if (line.has("gis")) {
    Step step("Writing " + line.text("gis"), line.quiet());
    writeQualityLayers(line.text("gis"), report, page.coverage(), page.strips(), checked.crs);
    step.done(report.block.control ? "strips, pairs, offsets, control" : "strips, pairs, offsets");
  }
  const std::string unreliable = whyUnreliable(report.block);
  return unreliable.empty() ? concludeRequirement(line, report) : app::conclude(line, unreliable);
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::runShared(argc, argv, commandLine, check);
}
