// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <iostream>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/survey_calibration.h>
#include <pcl_als/processing/survey_correction.h>
#include <pcl_als/report/calibration_page.h>
#include <pcl_als/report/calibration_tables.h>

#include "adjustment_options.h"
#include "command_line.h"
#include "flight_options.h"
#include "output_check.h"
#include "processes.h"
#include "remedy_options.h"
#include "report_options.h"
#include "strip_options.h"
#include "window_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;
namespace fs = std::filesystem;

CommandLine commandLine() {
  const CalibrationSettings defaults;
  CommandLine line("pcl_als_calibrate",
                   "estimates the biases of a LiDAR system's parameters from overlapping strips "
                   "and control (Habib et al. 2011).",
                   "STRIP... -trajectory T [-control C] -output calibration.json [options]",
                   "pcl_als_calibrate strip*.las -trajectory trajectory.csv -control control.csv "
                   "-output calibration.json");
  app::addFlightOptions(line);
  app::addControlOptions(line);
  line.addList(
      "reference",
      "FILE[:STD[:OFFSET]] ...: surfaces that strips are compared with (GeoTIFF, LAS, LAZ, "
      "PCD), standard deviation along the normal (0.02) and of a common height (0: known), "
      "m");
  app::addWindowOptions(line);
  app::addStripOptions(line);
  app::addChannelOption(line);
  line.addOptional("prior",
                   "known biases with standard deviations: boresight_roll=0:5,… (m, arcsec)");
  app::addSystemOptions(line);
  line.addOptional("pairs",
                   "pairs of strips that are used, e.g. 1:2,3:4 (default: all that overlap); other "
                   "strips are used for control only");
  app::addEstimateOption(line, "the data determine");
  app::addModelOption(line);
  app::addForceOption(line,
                      "inputs do not belong together or, with -corrected, the result should not "
                      "be applied");
  line.addFlag("vertical",
               "with quasi_rigorous: assume a vertical sensor aligned with the flight line, as "
               "published, instead of recovering pitch and crab from the points");
  line.addNeeded("output", "calibration.json to write");
  line.addOptional("corrected", "folder for corrected copies of all strips, also beyond -bounds");
  app::addResumeOption(line);
  line.addFlag("strip_corrections",
               "with -corrected: also correct the estimated trajectory errors (not with -bounds)");
  line.addOptional("report", "folder for report.html (with pictures), report.md, tables as CSV");
  app::addErrorOptions(line);
  app::addAccuracyOption(line,
                         "their root mean squares over the strips are the prior standard "
                         "deviations of trajectory errors that no option gives");
  line.add("max_distance", "largest normal distance of a pair at the start, m",
           defaults.max_normal_distance);
  line.add("points", "largest number of points that are used, millions",
           1e-6 * static_cast<double>(defaults.selection.point_budget));
  line.add("candidates",
           "number of these that may form pairs with patches of other strips, thousands",
           1e-3 * static_cast<double>(defaults.candidates));
  line.add("select",
           "largest number of pairs that are adjusted, thousands, chosen for the precision of the "
           "parameters; 0: all",
           1e-3 * static_cast<double>(defaults.pair_budget));
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
  if (line.has("prior")) settings.shared_errors.biases = biasPrior(line.text("prior"));
  app::readSystems(line, settings);
  settings.control_sigma = line.number("control_sigma", 1e-4, 10.0, "m");
  settings.max_normal_distance = line.number("max_distance", 0.05, 50.0, "m");
  settings.selection.point_budget =
      static_cast<std::size_t>(1e6 * line.number("points", 0.01, 1000.0, "millions"));
  settings.candidates =
      static_cast<std::size_t>(1e3 * line.number("candidates", 1.0, 1e6, "thousands"));
  settings.pair_budget =
      static_cast<std::size_t>(1e3 * line.number("select", 0.0, 1e6, "thousands"));
  settings.force = line.has("force");
  settings.threads = line.threads();
  return settings;
}

/// Outputs that cannot be written are refused before the computation.
void checkOutputs(const CommandLine& line) {
  if (line.has("corrected") && line.has("keep_readable"))
    throw UsageError("options -corrected and -keep_readable exclude each other (see -h)");
  if (line.has("strip_corrections") && line.has("bounds"))
    throw UsageError("options -strip_corrections and -bounds exclude each other (see -h)");
  app::checkWritable(line.text("output"));
  for (const char* option : {"corrected", "report"}) {
    if (line.has(option)) app::makeOutputFolder(option, line.text(option));
  }
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
  for (const CorrectedFile& file :
       correctPointFiles(files, outputsIn(line.text("corrected"), files), result, flight, options,
                         batch, app::progressOf(line))) {
    app::remark(line, file.attitude_remark);
    if (!file.uncovered.empty()) app::remark(line, "left as they are: " + file.uncovered);
  }
}

/// Its inputs are listed in the result.
ReportOrigin originOf(const CommandLine& line) {
  ReportOrigin origin = app::reportOrigin(line, {"control"});
  origin.inputs.clear();
  return origin;
}

void writeReport(const CommandLine& line, const SurveyCalibration& calibration,
                 const CalibrationPage& page) {
  const fs::path folder = line.text("report");
  Step step("Writing the report into " + folder.string(), line.quiet());
  writeCalibrationCsv(folder, calibration.result, calibration.areas, calibration.information);
  page.write(originOf(line), calibration.result, calibration.areas, calibration.flight);
  step.done(CalibrationPage::draws() ? "report.html with pictures, report.md"
                                     : "report.md; no report.html: built without VTK");
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
  const std::vector<std::string>& files = line.inputs(1, 100000);
  SurveyCalibrationOptions options;
  options.settings = settingsOf(line);
  if (line.has("pairs")) options.pairs = line.parsed("pairs", pairsIn);
  options.strips = app::stripChoice(line);
  app::checkFlightOptions(line);
  options.gps_week = app::gpsWeek(line);
  options.accuracy = app::accuracies(line);
  options.keep_position = line.given("position_sigma");
  options.keep_roll_pitch = line.given("roll_pitch_sigma");
  options.keep_heading = line.given("heading_sigma");
  const AttitudeUse attitude = attitudeToUse(line);
  const PointWindow window = app::windowOf(line);
  checkOutputs(line);
  Step step("Reading " + counted(files.size(), "point file"), line.quiet());
  SurveyReader survey(files, line.threads(), window, app::processes());
  step.done(grouped(survey.pointCount()) + " points");
  app::remarks(line, survey.reference().remarks);
  FlightFile whole;
  const auto flight = app::readFlight(line, survey.reference().crs, 0.0, attitude, files, &whole);
  options.reconstructed = whole.reconstructed();
  if (options.accuracy.empty() && !options.reconstructed) options.accuracy = whole.accuracy;
  options.control = app::controlOf(line);
  if (line.has("reference"))
    for (const std::string& text : line.list("reference"))
      options.references.push_back(openReference(text));
  CalibrationPage page(line.has("report"));
  options.observer = page.observer();
  SurveyCalibration calibration = calibrateSurvey(survey, flight, options, app::progressOf(line));
  CalibrationResult& result = calibration.result;
  app::nameOptions(line, result.warnings);
  for (const std::string& file : line.list("trajectory")) result.inputs.push_back(file);
  if (line.has("control")) result.inputs.push_back(line.text("control"));
  if (isRoot(app::processes())) {
    writeCalibration(line.text("output"), result);
    if (!line.quiet()) std::cout << '\n' << calibrationTables(result) << std::endl;
    if (line.has("report")) writeReport(line, calibration, page);
  }
  return conclude(line, files, flight, result);
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::runShared(argc, argv, commandLine, calibrate);
}
