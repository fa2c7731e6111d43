// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <iostream>

#include <pcl_als/calibration/survey_calibration.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/reference_source.h>
#include <pcl_als/processing/survey_correction.h>
#include <pcl_als/report/calibration_page.h>
#include <pcl_als/report/calibration_tables.h>

#include "adjustment_options.h"
#include "command_line.h"
#include "flight_options.h"
#include "hint_options.h"
#include "prior_options.h"
#include "processes.h"
#include "report_options.h"
#include "strip_options.h"
#include "window_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;
namespace fs = std::filesystem;

/// The files of -reference FILE[:STD[:OFFSET]].
std::vector<fs::path> referenceFiles(const CommandLine& line) {
  std::vector<fs::path> files;
  for (std::string file : line.list("reference")) {
    std::error_code error;
    while (!fs::exists(file, error) && file.find(':') != std::string::npos)
      file.erase(file.rfind(':'));
    files.emplace_back(file);
  }
  return files;
}

/// How many points and pairs are used.
void addWorkOptions(CommandLine& line) {
  const CalibrationSettings defaults;
  line.addNumber("max_distance", "largest normal distance of a pair at the start",
                 defaults.max_normal_distance, {0.05, 50.0, "m"});
  line.addNumber("points", "largest number of points that are used",
                 1e-6 * static_cast<double>(defaults.selection.point_budget),
                 {0.01, 1000.0, "millions"});
  line.addNumber("candidates", "number of these that may form pairs with patches of other strips",
                 1e-3 * static_cast<double>(defaults.candidates), {1.0, 1e6, "thousands"});
  line.addNumber("select",
                 "largest number of pairs that are adjusted, chosen for the precision of the "
                 "parameters; 0: all",
                 1e-3 * static_cast<double>(defaults.pair_budget), {0.0, 1e6, "thousands"});
}

void addOutputs(CommandLine& line) {
  line.addOutputFile("output", "calibration.json to write", {".json"}).needed();
  line.addOutputFolder("corrected",
                       "folder for corrected copies of all strips, also beyond -bounds",
                       app::copiesOfInputs());
  app::addResumeOption(line);
  line.addFlag("strip_corrections",
               "with -corrected: also correct the estimated trajectory errors (not with -bounds)")
      .in(app::Group::output);
  line.exclude({"corrected", "keep_readable"});
  line.exclude({"strip_corrections", "bounds"});
  line.makeDependent("strip_corrections", "corrected");
  app::addReportOption(line, "folder for report.html (with pictures), report.md, tables as CSV",
                       {"parameters.csv", "control.csv", "held.csv", "systems.csv",
                        "large_corrections.csv", "pairs.csv", "iterations.csv", "areas.csv"});
}

CommandLine commandLine() {
  CommandLine line("pcl_als_calibrate",
                   "estimates the biases of a LiDAR system's parameters from overlapping strips "
                   "and control (Habib et al. 2011).",
                   "STRIP... -trajectory T [-control C] -output calibration.json [options]",
                   "pcl_als_calibrate strip*.las -trajectory trajectory.csv -control control.csv "
                   "-output calibration.json");
  line.setArguments({{"", 1, app::Arguments::kAnyNumber}});
  app::addFlightOptions(line);
  app::addControlOptions(line);
  line.addInputFiles(
      "reference",
      "FILE[:STD[:OFFSET]] ...: surfaces that strips are compared with (GeoTIFF, LAS, LAZ, "
      "PCD), standard deviation along the normal (0.02) and of a common height (0: known), "
      "m",
      referenceFiles);
  app::addWindowOptions(line);
  app::addStripOptions(line);
  app::addChannelOption(line);
  line.addText("system_name",
               "name and serial number of the instrument, for pcl_als_history (default: as the "
               "point files state it)")
      .in(app::Group::inputs);
  app::addPriorOptions(line);
  app::addSystemOptions(line);
  line.addText("pairs",
               "pairs of strips that are used, e.g. 1:2,3:4 (default: all that overlap); other "
               "strips are used for control only")
      .in(app::Group::strips);
  app::addEstimateOption(line, "the data determine");
  app::addModelOption(line);
  app::addForceOption(line,
                      "inputs do not belong together or, with -corrected, the result should not "
                      "be applied");
  line.addFlag("vertical",
               "with quasi_rigorous: assume a vertical sensor aligned with the flight line, as "
               "published, instead of recovering pitch and crab from the points")
      .in(app::Group::estimation);
  addOutputs(line);
  app::addErrorOptions(line);
  line.addFlag("no_range_std",
               "give all ranges the noise of -range_noise alone, also where the points have the "
               "extra bytes range_std of decomposed waveforms, which are added to it otherwise")
      .in(app::Group::priors);
  app::addAccuracyOption(line,
                         "their root mean squares over the strips are the prior standard "
                         "deviations of trajectory errors that no option gives");
  line.makeDependent("control_sigma", "control");
  addWorkOptions(line);
  return line;
}

/// The attitude that is used: -vertical ignores the attitude that -model rigorous needs.
AttitudeUse attitudeToUse(const CommandLine& line) {
  const AttitudeUse use = app::attitudeUse(line);
  if (!line.has("vertical")) return use;
  if (use == AttitudeUse::needed) {
    throw UsageError(
        "options -model rigorous and -vertical exclude each other: -vertical assumes a vertical "
        "sensor, the rigorous model uses the attitude of the trajectory");
  }
  return AttitudeUse::ignore;
}

CalibrationSettings settingsOf(const CommandLine& line) {
  CalibrationSettings settings;
  settings.recover_attitude = !line.has("vertical");
  settings.estimate = app::parametersToEstimate(line);
  settings.noise = app::noiseOf(line);
  settings.shared_errors = app::sharedErrorsOf(line);
  app::readSystems(line, settings);
  settings.control_sigma = line.number("control_sigma");
  settings.max_normal_distance = line.number("max_distance");
  settings.selection.point_budget = static_cast<std::size_t>(1e6 * line.number("points"));
  settings.candidates = static_cast<std::size_t>(1e3 * line.number("candidates"));
  settings.pair_budget = static_cast<std::size_t>(1e3 * line.number("select"));
  settings.force = line.has("force");
  settings.threads = line.threads();
  return settings;
}

/// Writes the corrected copies of all strips (-corrected).
void writeCorrected(const CommandLine& line, const std::vector<std::string>& files,
                    const std::shared_ptr<const Trajectory>& flight,
                    const CalibrationResult& result) {
  FileCorrectionOptions options;
  options.strip_corrections = line.has("strip_corrections");
  options.gps_week = app::gpsWeek(line);
  options.threads = line.threads();
  options.force = line.has("force");
  options.check_trajectory = false;  // done with all strips together
  options.keep_uncovered = true;     // strips too small to calibrate may lie outside the trajectory
  BatchOptions batch = app::batchOptions(line);
  batch.joint = true;
  const std::vector<CorrectedFile> corrected =
      correctPointFiles(files, outputsIn(line.text("corrected"), files), result, flight, options,
                        batch, app::progressOf(line));
  for (std::size_t i = 0; i < files.size(); ++i) {
    const CorrectedFile& file = corrected[i];
    app::remark(line, file.attitude_remark);
    if (!file.uncovered.empty()) app::remark(line, "left as they are: " + file.uncovered);
    for (const std::string& text : file.copy_remarks) app::remark(line, files[i] + ": " + text);
  }
}

/// Its inputs are listed in the result.
ReportOrigin originOf(const CommandLine& line) {
  ReportOrigin origin = app::reportOrigin(line);
  origin.inputs.clear();
  return origin;
}

void writeReport(const CommandLine& line, const SurveyCalibration& calibration,
                 const CalibrationPage& page) {
  const fs::path folder = line.text("report");
  Step step("Writing the report into " + folder.string(), line.quiet());
  writeCalibrationCsv(folder, calibration.result, calibration.areas, calibration.information);
  page.write(originOf(line), calibration.result, calibration.areas, calibration.flight);
  step.done("report.html with pictures, report.md");
}

/// The verdict's exit status; corrected files only of a calibration that may be applied.
int conclude(const CommandLine& line, const std::vector<std::string>& files,
             const std::shared_ptr<const Trajectory>& flight, const CalibrationResult& result) {
  const bool usable = result.verdict.usable();
  const int status = app::conclude(line, usable ? "" : result.verdict.text());
  if (line.has("corrected") && !usable && !line.has("force")) {
    std::cerr << "pcl_als_calibrate: no corrected files are written; -force writes them"
              << std::endl;
  } else if (line.has("corrected")) {
    writeCorrected(line, files, flight, result);
  }
  return status;
}

int calibrate(const CommandLine& line) {
  const std::vector<std::string>& files = line.inputs();
  CalibrationOptions options;
  options.settings = settingsOf(line);
  if (line.has("system_name")) options.system_name = line.text("system_name");
  const app::GivenPrior prior(line, options.settings);
  if (line.has("pairs")) options.pairs = line.parsed("pairs", pairsIn);
  options.use_range_std = !line.has("no_range_std");
  options.strips = app::stripChoice(line);
  app::checkFlightOptions(line);
  options.gps_week = app::gpsWeek(line);
  options.accuracy = app::accuracies(line);
  options.keep_position = line.given("position_sigma");
  options.keep_roll_pitch = line.given("roll_pitch_sigma");
  options.keep_heading = line.given("heading_sigma");
  const AttitudeUse attitude = attitudeToUse(line);
  const PointWindow window = app::windowOf(line);
  Step step("Reading " + counted(files.size(), "point file"), line.quiet());
  SurveyReader survey(files, line.threads(), window, app::processes());
  step.done(grouped(survey.pointCount()) + " points");
  app::remarks(line, survey.reference().remarks);
  LoadedTrajectory whole;
  const auto flight =
      app::loadTrajectory(line, survey.reference().crs, 0.0, attitude, files, &whole);
  options.reconstructed = whole.reconstructed();
  if (options.reconstructed)
    options.path_accuracy = whole.accuracy;
  else if (options.accuracy.empty())
    options.accuracy = whole.accuracy;
  options.control = app::controlOf(line);
  for (const std::string& text : line.list("reference"))
    options.references.push_back(openReference(text));
  CalibrationPage page(line.has("report"));
  options.observer = page.observer();
  SurveyCalibration calibration = calibrateSurvey(survey, flight, options, app::progressOf(line));
  CalibrationResult& result = calibration.result;
  prior.warnOfSameStrips(result);
  app::nameOptions(line, result.warnings);
  for (const fs::path& file : line.optionInputs()) result.inputs.push_back(file.string());
  if (isRoot(app::processes())) {
    writeCalibration(line.text("output"), result);
    if (!line.quiet()) std::cout << '\n' << result.fullReport() << std::endl;
    if (line.has("report")) writeReport(line, calibration, page);
  }
  return conclude(line, files, flight, result);
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::runShared(argc, argv, commandLine, calibrate);
}
