// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/image_orientation.h>
#include <pcl_als/report/orientation_page.h>
#include <pcl_als/report/orientation_report.h>

#include "command_line.h"
#include "output_check.h"
#include "report_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;

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
  line.addNeeded("images",
                 "approximate orientations: CSV image,x,y,z,omega,phi,kappa[,sigma_position,"
                 "sigma_angle], m and degrees; with standard deviations they are observations");
  line.addOptional("measurements",
                   "image coordinates: CSV image,kind,feature,x,y[,sigma], kind point or line, in "
                   "the unit of the camera (default: measurements.csv beside the images)");
  line.addNeeded("lines", "control: CSV as pcl_als_lines writes it");
  line.addNeeded("camera", "camera.json: focal length, principal point, distortion");
  line.addOptional("checkpoints", "surveyed points that are not control: CSV id,x,y,z[,sigma]");
  line.addNeeded("output", "orientation.json to write");
  line.addOptional("report", "folder for report.html with pictures, report.md and tables as CSV");
  line.add("assign",
           "assign lines whose names are not in the control by position, up to this distance on "
           "the ground, m; 0: by name only",
           defaults.assign_distance);
  line.add<std::string>("formulation",
                        "coplanarity, or expanded (end points with a covariance expanded along "
                        "the line)",
                        "coplanarity");
  line.add("image_sigma",
           "standard deviation of image coordinates without one, their unit; 0: 0.5 px or 0.003 mm",
           defaults.image_sigma);
  line.addFlag("no_rejection", "least squares with all observations");
  return line;
}

ImageOrientationOptions optionsOf(const CommandLine& line) {
  ImageOrientationOptions options;
  if (line.choice("formulation", {"coplanarity", "expanded"}) == 1)
    options.bundle.formulation = LineFormulation::expanded_covariance;
  options.bundle.robust = !line.has("no_rejection");
  options.assign_distance = line.number("assign", 0.0, 100.0, "m");
  options.image_sigma = line.number("image_sigma", 0.0, 100.0, "(unit of the camera)");
  return options;
}

ImageBlockFiles filesOf(const CommandLine& line) {
  ImageBlockFiles files;
  files.images = line.text("images");
  files.measurements = line.has("measurements") ? std::filesystem::path(line.text("measurements"))
                                                : ImageBlockFiles::besideImages(files.images);
  files.lines = line.text("lines");
  files.camera = line.text("camera");
  if (line.has("checkpoints")) files.check_points = line.text("checkpoints");
  return files;
}

int orient(const CommandLine& line) {
  line.inputs(0, 0);
  const ImageOrientationOptions options = optionsOf(line);
  const ImageBlockFiles files = filesOf(line);
  app::checkWritable(line.text("output"));
  if (line.has("report")) app::makeOutputFolder("report", line.text("report"));
  const ImageOrientationResult result = orientImages(files, options, app::progressOf(line));
  writeOrientation(line.text("output"), result);
  if (!line.quiet()) std::cout << orientationText(result) << std::flush;
  if (line.has("report")) {
    ReportOrigin origin = app::reportOrigin(line, {"images", "lines", "camera", "checkpoints"});
    origin.inputs.push_back(files.measurements);
    writeOrientationPage(origin, result);
  }
  return app::conclude(line, result.bundle.reliable() ? "" : result.bundle.message);
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, orient);
}
