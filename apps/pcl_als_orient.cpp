// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/processing/image_orientation.h>
#include <pcl_als/report/orientation_page.h>
#include <pcl_als/report/orientation_report.h>

#include "command_line.h"
#include "report_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;

/// The file of -measurements, or the one that is read without it.
std::vector<std::filesystem::path> measurements(const CommandLine& line) {
  if (line.has("measurements")) return {line.text("measurements")};
  if (!line.has("images")) return {};
  return {ImageBlockFiles::besideImages(line.text("images"))};
}

CommandLine commandLine() {
  const ImageOrientationOptions defaults;
  CommandLine line(
      "pcl_als_orient",
      "orients an image block by a bundle adjustment with lines as control, and "
      "compares it with check points.",
      "-images images.csv -lines lines.csv -camera camera.json -output "
      "orientation.json",
      "pcl_als_orient -images images.csv -lines lines.csv -camera camera.json "
      "-checkpoints checkpoints.csv -assign 3 -output orientation.json -report report");
  line.addInputFile("images",
                    "approximate orientations: CSV image,x,y,z,omega,phi,kappa[,sigma_position,"
                    "sigma_angle], m and degrees; with standard deviations they are observations")
      .needed();
  line.addInputFile("measurements",
                    "image coordinates: CSV image,kind,feature,x,y[,sigma], kind point or line, in "
                    "the unit of the camera (default: measurements.csv beside the images)",
                    measurements);
  line.addInputFile("lines", "control: CSV as pcl_als_lines writes it").needed();
  line.addInputFile("camera", "camera.json: focal length, principal point, distortion").needed();
  line.addInputFile("checkpoints", "surveyed points that are not control: CSV id,x,y,z[,sigma]");
  line.addOutputFile("output", "orientation.json to write", {".json"}).needed();
  app::addReportOption(line, "folder for report.html with pictures, report.md and tables as CSV",
                       {"checkpoints.csv", "images.csv", "blunders.csv", "lines.csv"});
  line.addNumber("assign",
                 "assign lines whose names are not in the control by position, up to this "
                 "distance on the ground; 0: by name only",
                 defaults.assign_distance, {0.0, 100.0, "m"});
  line.addChoice("formulation",
                 "coplanarity, or expanded (end points with a covariance expanded along "
                 "the line)",
                 {"coplanarity", "expanded"}, "coplanarity");
  line.addNumber("image_sigma",
                 "standard deviation of image coordinates without one, in the unit of the camera; "
                 "0: 0.5 px or 0.003 mm",
                 defaults.image_sigma, {0.0, 100.0})
      .in(app::Group::priors);
  line.addFlag("no_rejection", "least squares with all observations");
  return line;
}

ImageOrientationOptions optionsOf(const CommandLine& line) {
  ImageOrientationOptions options;
  if (line.choice("formulation") == 1)
    options.bundle.formulation = LineFormulation::expanded_covariance;
  options.bundle.robust = !line.has("no_rejection");
  options.assign_distance = line.number("assign");
  options.image_sigma = line.number("image_sigma");
  return options;
}

ImageBlockFiles filesOf(const CommandLine& line) {
  ImageBlockFiles files;
  files.images = line.text("images");
  files.measurements = measurements(line).front();
  files.lines = line.text("lines");
  files.camera = line.text("camera");
  if (line.has("checkpoints")) files.check_points = line.text("checkpoints");
  return files;
}

int orient(const CommandLine& line) {
  const ImageOrientationOptions options = optionsOf(line);
  const ImageBlockFiles files = filesOf(line);
  const ImageOrientationResult result = orientImages(files, options, app::progressOf(line));
  writeFile(line.text("output"), orientationJson(result));
  if (!line.quiet()) std::cout << orientationText(result) << std::flush;
  if (line.has("report")) {
    writeOrientationPage(app::reportOrigin(line), result);
  }
  return app::conclude(line, result.bundle.reliable() ? "" : result.bundle.message);
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, orient);
}
