// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/raster_io.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/calibration_check.h>
#include <pcl_als/processing/survey_correction.h>

#include "command_line.h"
#include "flight_options.h"
#include "processes.h"

namespace {

using namespace pcl_als;
using app::CommandLine;

void addUncertaintyOptions(CommandLine& line) {
  const app::OptionGroup group(line, app::Group::output);
  line.addFlag(
      "uncertainty",
      "add extra bytes sigma_horizontal (in the plane, compare RMSE_H) and sigma_vertical: "
      "standard deviation of every point, m (LAS, LAZ); range_std of decomposed waveforms is "
      "used where it exceeds the range error of the calibration");
  line.addOutputFile("uncertainty_raster",
                     "GeoTIFF of these standard deviations, root mean squares in cells",
                     {".tif", ".tiff"});
  line.addNumber("uncertainty_cell", "size of its cells", 2.0, {0.01, 1e4, "m"});
  line.exclude({"corrected", "uncertainty_raster"});
  line.makeDependent("uncertainty_cell", "uncertainty_raster");
}

CommandLine commandLine() {
  CommandLine line("pcl_als_apply",
                   "removes known system biases from a point file (Habib et al. 2011, Eq. 13), or "
                   "applies them.",
                   "IN OUT -trajectory T -calibration calibration.json [options], or STRIP… "
                   "-corrected DIR …",
                   "pcl_als_apply strip1.las corrected1.las -trajectory trajectory.csv "
                   "-calibration calibration.json");
  line.setArguments(
      {{"corrected", 1, app::Arguments::kAnyNumber}, {"", 1, 1, {".las", ".laz", ".pcd"}}});
  app::addFlightOptions(line);
  line.addInputFile("calibration", "calibration.json or history.json with the biases");
  line.addText("bias",
               "NAME=VALUE,... instead of a calibration: assumed - true, in m, arcsec or 1; "
               "names as in calibration.json")
      .formerly("biases")
      .in(app::Group::inputs);
  line.exclude({"calibration", "bias"}, true);
  line.addOutputFolder("corrected", "folder for the corrected copies of any number of files",
                       app::copiesOfInputs());
  app::addResumeOption(line);
  app::addModelOption(line);
  line.addFlag("invert", "apply the biases instead of removing them");
  line.addFlag("strip_corrections",
               "with -calibration: also correct the estimated trajectory errors of each strip");
  line.addChoice("check",
                 "whether the strips, of which two at least must overlap, are compared with each "
                 "other before they are corrected, to see whether the calibration holds for them "
                 "(reads them twice more; exit status 3 where it does not): where -calibration is "
                 "of another flight and -corrected is given, always, or never",
                 {"other_flight", "yes", "no"}, "other_flight");
  line.makeDependent("check", "calibration");
  line.exclude({"check", "invert"});
  addUncertaintyOptions(line);
  app::addAccuracyOption(line,
                         "for -uncertainty at times of which the calibration knows nothing "
                         "(default: the trajectory's own columns)");
  app::addForceOption(
      line,
      "the calibration's verdict is not \"usable\", a file was corrected with it before, or inputs "
      "do not belong together");
  line.addFlag(
          "no_record",
          "do not record the correction in the output (default: LAS in a VLR, PCD in a comment "
          "line, so that it is not made twice)")
      .in(app::Group::output);
  line.addFlag("keep_uncovered",
               "leave any number of points without a trajectory unchanged (default: up to 1 % of a "
               "file, which are counted; a file with more is refused)");
  return line;
}

/// Biases and the trajectory window they belong to; 0 where the file does not say.
CalibrationResult biasesOf(const CommandLine& line) {
  if (line.has("calibration")) return app::usableCalibration(line);
  CalibrationResult result;
  const SystemVector biases = line.parsed("bias", biasesIn);
  for (int i = 0; i < kSystemParameterCount; ++i) result.parameters[i].bias = biases[i];
  result.converged = true;
  return result;
}

/// A calibration's biases belong to its model; biases by themselves take the best there is.
AttitudeUse attitudeUse(const CommandLine& line, const CalibrationResult& calibration) {
  return line.has("bias") ? app::attitudeUse(line) : trajectoryLoadingOptions(calibration).attitude;
}

FileCorrectionOptions optionsOf(const CommandLine& line, const CalibrationResult& calibration) {
  FileCorrectionOptions options;
  options.strip_corrections = line.has("strip_corrections");
  if (options.strip_corrections && calibration.strip_errors.empty()) {
    throw UsageError("option -strip_corrections: the calibration has no strip corrections");
  }
  options.invert = line.has("invert");
  options.keep_uncovered = line.has("keep_uncovered");
  options.force = line.has("force");
  options.record = !line.has("no_record");
  options.gps_week = app::gpsWeek(line);
  options.threads = line.threads();
  options.uncertainty = line.has("uncertainty") || line.has("uncertainty_raster");
  if (!line.has("uncertainty_raster")) return options;
  options.deviation_cell = line.number("uncertainty_cell");
  return options;
}

/// Biases that are given by themselves are used with the attitude of the trajectory, where it has
/// one.
AttitudeSource attitudeOf(const Trajectory& flight) {
  if (!flight.hasAttitude()) return AttitudeSource::points;
  return flight.attitudeIsNominal() ? AttitudeSource::nominal : AttitudeSource::trajectory;
}

void applyToMany(const CommandLine& line, const std::vector<std::string>& files,
                 const CalibrationResult& calibration,
                 const std::shared_ptr<const Trajectory>& flight,
                 const FileCorrectionOptions& options) {
  const std::vector<CorrectedFile> corrected =
      correctPointFiles(files, outputsIn(line.text("corrected"), files), calibration, flight,
                        options, app::batchOptions(line), app::progressOf(line));
  for (std::size_t i = 0; i < files.size(); ++i)
    for (const std::string& text : corrected[i].remarks)
      if (!text.empty()) app::remark(line, files[i] + ": " + text);
}

bool isToBeChecked(const CommandLine& line, const CalibrationResult& calibration,
                   const Trajectory& flight) {
  if (line.has("bias") || line.has("invert") || line.text("check") == "no") return false;
  return line.text("check") == "yes" ||
         (line.has("corrected") && mayBeOfAnotherFlight(calibration, line.inputs(), flight));
}

/// States whether the calibration holds for the strips. Returns why it does not; empty if it does,
/// or is not checked.
std::string check(const CommandLine& line, const CalibrationResult& calibration,
                  const std::shared_ptr<const Trajectory>& flight) {
  if (!isToBeChecked(line, calibration, *flight)) return {};
  CalibrationCheckOptions options;
  options.gps_week = app::gpsWeek(line);
  options.threads = line.threads();
  options.force = line.has("force");
  options.processes = app::processes();
  const CalibrationCheck found =
      checkCalibration(line.inputs(), calibration, flight, options, app::progressOf(line));
  std::string text = found.text(line.text("calibration"));
  if (!found.holds()) return text;
  app::remark(line, text);
  return {};
}

int apply(const CommandLine& line) {
  const std::vector<std::string>& files = line.inputs();
  CalibrationResult calibration = biasesOf(line);
  FileCorrectionOptions options = optionsOf(line, calibration);
  const PointReference reference = commonReference(files);
  app::remarks(line, reference.remarks);
  LoadedTrajectory stated;
  const auto flight = app::loadTrajectory(line, reference.crs, calibration.line_fit_half_width,
                                          attitudeUse(line, calibration), files, &stated);
  options.trajectory_accuracy =
      line.has("trajectory_accuracy") ? app::accuracies(line) : std::move(stated.accuracy);
  if (line.has("bias")) calibration.attitude = attitudeOf(*flight);
  app::remark(line, (options.invert ? "applying biases: " : "removing biases: ") +
                        describeBiases(calibration));

  const std::string doubt = check(line, calibration, flight);
  if (line.has("corrected")) {
    applyToMany(line, files, calibration, flight, options);
    return app::conclude(line, doubt);
  }
  FileCorrectionResult result = correctPointFile(files[0], line.output(), calibration, flight,
                                                 options, app::progressOf(line));
  app::remarks(line, result.remarks);
  if (result.deviation_raster) {
    result.deviation_raster->grid.crs = reference.crs;
    writeRaster(line.text("uncertainty_raster"), *result.deviation_raster);
  }
  return app::conclude(line, doubt);
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::runShared(argc, argv, commandLine, apply);
}
