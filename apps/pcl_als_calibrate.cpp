// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <iostream>

#include <pcl_als/calibration/quasi_rigorous_calibration.h>
#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/file_correction.h>
#include <pcl_als/processing/survey_reader.h>
#include <pcl_als/report/calibration_page.h>
#include <pcl_als/report/calibration_tables.h>

#include "adjustment_options.h"
#include "command_line.h"
#include "flight_options.h"
#include "output_check.h"
#include "report_options.h"
#include "strip_options.h"

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
  line.addOptional("control", "control points: CSV id,x,y,z[,sigma], used vertically");
  app::addUnitsOption(line, "control", "the control file");
  app::addStripOptions(line);
  line.addOptional(
      "pairs",
      "strip pairs to use, e.g. 1:2,3:4 (default: all that overlap); without -control, "
      "other strips take no part");
  app::addEstimateOption(line, "the data determine");
  app::addModelOption(line);
  app::addForceOption(line,
                      "inputs do not belong together or, with -corrected, the result should not "
                      "be applied");
  line.addFlag("vertical",
               "with quasi_rigorous: take the sensor as vertical and looking along the line of "
               "flight, as published, instead of recovering pitch and crab from the points");
  line.addOptional("output", "calibration.json to write (needed)");
  line.addOptional("corrected", "folder for corrected copies of all strips");
  line.addFlag("strip_corrections",
               "with -corrected: take out what was found wrong with each strip's trajectory, too");
  line.addOptional("report",
                   "folder for report.html (pictures inside), report.md and tables as CSV");
  app::addErrorOptions(line);
  line.add("max_distance", "normal distance of a pair at the start, m",
           defaults.max_normal_distance);
  line.add("points", "points used at most, millions",
           1e-6 * static_cast<double>(defaults.selection.point_budget));
  line.add("candidates", "of them, points that look for a patch in other strips, thousands",
           1e-3 * static_cast<double>(defaults.candidates));
  line.add("select",
           "pairs adjusted at most, thousands: those that determine the parameters; 0: all",
           1e-3 * static_cast<double>(defaults.pair_budget));
  return line;
}

std::vector<std::pair<std::string, std::string>> stripPairs(const CommandLine& line) {
  std::vector<std::pair<std::string, std::string>> pairs;
  if (!line.has("pairs")) return pairs;
  for (const std::string& text : app::splitList(line.text("pairs"))) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == text.size()) {
      throw UsageError("option -pairs: '" + text + "' is not A:B");
    }
    pairs.emplace_back(text.substr(0, colon), text.substr(colon + 1));
  }
  if (pairs.empty()) throw UsageError("option -pairs: names no pair");
  return pairs;
}

/// Without the pairs of strips that have no usable points; those are named in \a warnings.
std::vector<std::pair<std::string, std::string>> usablePairs(
    const std::vector<std::pair<std::string, std::string>>& pairs, const SurveyReader& survey,
    std::vector<std::string>& warnings) {
  const auto missing = [&](const std::string& name) -> const StripArrangement::Label* {
    const std::vector<std::string>& strips = survey.strips();
    if (std::find(strips.begin(), strips.end(), name) != strips.end()) return nullptr;
    for (const StripArrangement::Label& label : survey.arrangement().labels()) {
      if (label.strip == name) return &label;
    }
    return nullptr;  // unknown: the calibration says which there are
  };
  std::vector<std::pair<std::string, std::string>> usable;
  for (const auto& [a, b] : pairs) {
    const auto* label = missing(a) != nullptr ? missing(a) : missing(b);
    if (label == nullptr) {
      usable.emplace_back(a, b);
      continue;
    }
    if (label->reason == LeftOutReason::excluded)
      throw UsageError("option -pairs: names strip '" + label->strip +
                       "', which -strips or -without leaves out");
    warnings.push_back("pair " + a + ":" + b + " is left out with strip " + label->strip);
  }
  if (usable.empty() && !pairs.empty())
    throw InputError("option -pairs: no pair is left; " + warnings.back());
  return usable;
}

/// -vertical ignores the attitude that -model rigorous is about.
app::AttitudeUse attitudeToUse(const CommandLine& line) {
  const app::AttitudeUse use = app::attitudeUse(line);
  if (!line.has("vertical")) return use;
  if (use == app::AttitudeUse::needed) {
    throw UsageError(
        "options -model rigorous and -vertical exclude each other: -vertical takes the sensor as "
        "vertical, the rigorous model takes its attitude from the trajectory");
  }
  return app::AttitudeUse::ignore;
}

CalibrationSettings settingsOf(const CommandLine& line) {
  CalibrationSettings settings;
  settings.recover_attitude = !line.has("vertical");
  settings.estimate = app::parametersToEstimate(line);
  settings.noise = app::noiseOf(line);
  settings.shared_errors = app::sharedErrorsOf(line);
  settings.control_sigma = app::controlSigmaOf(line);
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

/// What can be known to fail should fail before the work, not after it.
void checkOutputs(const CommandLine& line) {
  if (!line.has("output")) throw UsageError("option -output is needed");
  app::checkWritable(line.text("output"));
  for (const char* option : {"corrected", "report"}) {
    if (line.has(option)) app::makeOutputFolder(option, line.text(option));
  }
}

/// For a message: what was not used, in short.
std::string leftOutText(const std::vector<LeftOutPoints>& parts) {
  std::string text;
  for (const std::string& part : describe(parts)) text += "; " + part;
  return text;
}

/// Both looks at the points and the adjustment.
CalibrationResult calibrateSurvey(const CommandLine& line, SurveyReader& survey,
                                  CalibrationPage& page, QuasiRigorousCalibration& calibration) {
  for (const std::string& id : survey.strips()) calibration.addStrip(id);
  {
    Step step("Surveying the block", line.quiet());
    survey.read([&](int strip, const CalibrationPoint* points, std::size_t count) {
      calibration.survey(strip, points, count);
      page.add(strip, points, count);
    });
    try {
      calibration.chooseAreas();
    } catch (const InputError& error) {
      throw InputError(error.what() + leftOutText(survey.leftOut()));
    }
    step.done(counted(calibration.pairs().size(), "overlapping pair") + ", " +
              counted(calibration.areas().size(), "area"));
    for (const std::string& text : calibration.attitudeRemarks()) app::remark(line, text);
  }
  {
    Step step("Reading the areas", line.quiet());
    survey.read([&](int strip, const CalibrationPoint* points, std::size_t count) {
      calibration.load(strip, points, count);
    });
    step.done(grouped(calibration.loadedPoints()) + " points");
  }
  Step step("Adjusting", line.quiet());
  int iteration = 0;
  calibration.setProgress([&](const CalibrationIteration& last) {
    app::remark(line, "iteration " + std::to_string(++iteration) + ": " +
                          grouped(last.correspondences) + " pairs, sigma0 " +
                          std::to_string(last.sigma0) + ", largest update " +
                          std::to_string(1000.0 * last.largest_update) + " mm");
  });
  CalibrationResult result = calibration.calibrate();
  result.left_out = survey.leftOut();
  for (const std::string& text : describe(result.left_out)) result.warnings.push_back(text);
  step.done(result.converged ? "converged" : "not converged");
  return result;
}

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
  for (const std::string& file : files) {
    const fs::path output = fs::path(line.text("corrected")) / fs::path(file).filename();
    Step step("Writing " + output.string(), line.quiet());
    const FileCorrectionResult corrected =
        correctPointFile(file, output, result, flight, options, app::progressOf(step));
    step.done(grouped(corrected.points) + " points");
    app::remark(line, corrected.attitude_remark);
    if (corrected.coverage.missed() == 0) continue;
    app::remark(line, "left as they are: " + corrected.coverage.describe(*flight));
  }
}

/// Its inputs are listed in the result.
ReportOrigin originOf(const CommandLine& line) {
  ReportOrigin origin = app::reportOrigin(line, {"control"});
  origin.inputs.clear();
  return origin;
}

void writeReport(const CommandLine& line, const CalibrationResult& result,
                 const QuasiRigorousCalibration& calibration, const CalibrationPage& page) {
  const fs::path folder = line.text("report");
  Step step("Writing the report into " + folder.string(), line.quiet());
  writeCalibrationCsv(folder, result, calibration.areas(), calibration.informationShares());
  page.write(originOf(line), result, calibration.areas(), calibration.trajectory());
  step.done(CalibrationPage::draws() ? "report.html with pictures, report.md"
                                     : "report.md; no report.html: built without VTK");
}

int calibrate(int argc, char** argv) {
  CommandLine line = commandLine();
  if (!line.parse(argc, argv)) return app::kDone;
  const std::vector<std::string>& files = line.inputs(1, 100000);
  CalibrationSettings settings = settingsOf(line);
  const auto pairs = stripPairs(line);
  const StripChoice choice = app::stripChoice(line);
  const app::AttitudeUse attitude = attitudeToUse(line);
  checkOutputs(line);
  Step step("Reading " + counted(files.size(), "point file"), line.quiet());
  SurveyReader survey(files, line.threads());
  step.done(grouped(survey.pointCount()) + " points");
  app::remarks(line, survey.reference().remarks);
  const auto trajectory = app::readFlight(line, survey.reference().crs, 0.0, attitude);
  for (const std::string& text :
       survey.choose(choice, {trajectory.get(), app::gpsWeek(line), true})) {
    app::remark(line, text);
  }
  settings.resolution = survey.resolution();
  QuasiRigorousCalibration calibration(trajectory, settings, survey.corner());
  std::vector<std::string> warnings;
  calibration.setPairs(usablePairs(pairs, survey, warnings));
  if (line.has("control"))
    calibration.setControl(readControl(line.text("control"), app::unitOption(line, "control")));
  CalibrationPage page(survey, line.has("report"));
  CalibrationResult result = calibrateSurvey(line, survey, page, calibration);
  result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
  result.inputs = files;
  result.inputs.push_back(line.text("trajectory"));
  if (line.has("control")) result.inputs.push_back(line.text("control"));
  writeCalibration(line.text("output"), result);
  if (!line.quiet()) std::cout << '\n' << calibrationTables(result) << std::endl;
  if (line.has("report")) writeReport(line, result, calibration, page);
  const bool usable = result.verdict.usable();
  if (!usable) {
    std::cerr << "pcl_als_calibrate: no reliable answer: " << result.verdict.text() << std::endl;
  }
  if (line.has("corrected") && !usable && !line.has("force")) {
    std::cerr << "pcl_als_calibrate: no corrected files are written; -force writes them"
              << std::endl;
  } else if (line.has("corrected")) {
    writeCorrected(line, files, trajectory, result);
  }
  return usable ? app::kDone : app::kNoReliableAnswer;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run("pcl_als_calibrate", [argc, argv] { return calibrate(argc, argv); });
}
