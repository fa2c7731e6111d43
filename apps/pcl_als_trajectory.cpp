// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/trajectory_conversion.h>
#include <pcl_als/processing/trajectory_from_points.h>
#include <pcl_als/report/trajectory_page.h>

#include "command_line.h"
#include "flight_options.h"
#include "report_options.h"
#include "strip_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;

CommandLine commandLine() {
  CommandLine line("pcl_als_trajectory",
                   "reconstructs a trajectory, with its standard deviations, from the points of "
                   "strips: from rays through the first and last returns of pulses and from "
                   "recorded scan angles. With -trajectory: converts a trajectory and corrects it "
                   "by a calibration; lever arm and strip corrections are taken out (boresight, "
                   "range bias and scan angle scale belong to the scanner).",
                   "STRIP... -output trajectory.csv|.sbet, or -trajectory T [-calibration "
                   "calibration.json] -output corrected.csv|.sbet",
                   "pcl_als_trajectory strip*.las -output trajectory.csv");
  line.setArguments({{"trajectory", 0, 0}, {"", 1, app::Arguments::kAnyNumber}});
  app::addTrajectoryOptions(line, "to convert, in place of points");
  app::addAccuracyOption(
      line, "standard deviations to write (default: those of the trajectory's own columns)");
  line.addInputFile("calibration", "calibration.json that is applied");
  line.addFlag("lever_arm_only", "do not apply the strip corrections of the calibration");
  for (const char* name : {"calibration", "trajectory_accuracy", "lever_arm_only"})
    line.makeDependent(name, "trajectory");
  line.addOutputFile("output",
                     "trajectory to write: .csv with columns of standard deviations where "
                     "they are known; .sbet or .out as SBET in WGS 84, with NAME_smrmsg.out",
                     {".csv", ".sbet", ".out"})
      .needed();
  app::addForceOption(line, "the calibration's verdict is not \"usable\"");
  app::addStripOptions(line, false);
  app::addReportOption(line,
                       "of points: folder for report.html (pictures inside), report.md and tables "
                       "as CSV",
                       {"paths.csv", "rays.csv", "angles.csv"});
  line.addFlag("positions", "of points: positions only, without recovering the attitude")
      .in(app::Group::estimation);
  return line;
}

/// The trajectory of the points of files.
int reconstruct(const CommandLine& line) {
  app::Step step("Reading " + counted(line.inputs().size(), "point file"), line.quiet());
  SurveyReader survey(line.inputs(), line.threads());
  step.done(grouped(survey.pointCount()) + " points");
  app::remarks(line, survey.reference().remarks);
  const std::string crs = app::trajectoryReading(line, survey.reference().crs).crs;
  checkTrajectoryOutput(line.text("output"), crs);
  ReconstructionOptions options;
  options.strips = app::stripChoice(line);
  options.attitude = !line.has("positions");
  TrajectoryPage page(line.has("report"));
  options.observer = page.observer();
  const ReconstructedTrajectory flight =
      reconstructTrajectory(survey, options, app::progressOf(line));
  writeReconstruction(flight, line.text("output"), crs);
  if (line.has("report")) page.write(app::reportOrigin(line), flight, line.inputs());
  if (flight.incomplete.empty()) return app::kDone;
  std::cerr << "pcl_als_trajectory: not complete: " << flight.incomplete << std::endl;
  return app::kNoReliableAnswer;
}

int trajectory(const CommandLine& line) {
  if (!line.has("trajectory")) return reconstruct(line);
  TrajectoryConversionOptions options;
  options.reading = app::trajectoryReading(line, {});
  CalibrationResult calibration;
  if (line.has("calibration")) {
    calibration = readCalibration(line.text("calibration"));
    options.calibration = &calibration;
  }
  options.strip_corrections = !line.has("lever_arm_only");
  options.force = line.has("force");
  options.accuracy = app::accuracies(line);
  convertTrajectory(app::trajectoryFiles(line), line.text("output"), options,
                    app::progressOf(line));
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, trajectory);
}
