// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/io/trajectory_writer.h>
#include <pcl_als/processing/trajectory_conversion.h>

#include "command_line.h"
#include "flight_options.h"
#include "output_check.h"

namespace {

using namespace pcl_als;
using app::CommandLine;

CommandLine commandLine() {
  CommandLine line("pcl_als_trajectory",
                   "converts a trajectory and corrects it by a calibration: lever arm and strip "
                   "corrections are taken out (boresight, range bias and scan angle scale belong "
                   "to the scanner).",
                   "-trajectory T [-calibration calibration.json] -output corrected.csv|.sbet",
                   "pcl_als_trajectory -trajectory flight.sbet -crs EPSG:32611 -calibration "
                   "calibration.json -output corrected.sbet");
  app::addTrajectoryOptions(line);
  app::addAccuracyOption(
      line, "standard deviations to write (default: those of the trajectory's own columns)");
  line.addOptional("calibration", "calibration.json that is applied");
  line.addFlag("lever_arm_only", "do not apply the strip corrections of the calibration");
  line.addOptional("output",
                   "trajectory to write (needed): .csv with columns of standard deviations where "
                   "they are known; .sbet or .out as SBET in WGS 84, with NAME_smrmsg.out");
  app::addForceOption(line, "the calibration's verdict is not \"usable\"");
  return line;
}

int trajectory(int argc, char** argv) {
  CommandLine line = commandLine();
  if (!line.parse(argc, argv)) return app::kDone;
  line.inputs(0, 0);
  if (!line.has("output")) throw UsageError("option -output is needed");
  app::checkWritable(line.text("output"));
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
  return pcl_als::app::run("pcl_als_trajectory", [argc, argv] { return trajectory(argc, argv); });
}
