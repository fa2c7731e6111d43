// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <memory>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/picture/survey_picture.h>
#if PCL_ALS_WITH_VTK
#include <pcl_als/visualization/point_scene.h>
#endif

#include "command_line.h"
#include "picture_options.h"
#include "strip_options.h"
#include "window_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;

CommandLine commandLine() {
  CommandLine line(
      "pcl_als_view",
      "draws point files as a picture, from above or obliquely, or shows them in a window",
      "FILE... -output PICTURE.png [options]",
      "pcl_als_view strip*.las -output strips.png -color strip -shade edl");
  line.setArguments({{"", 1, app::Arguments::kAnyNumber}});
  line.addOutputFile("output", "picture to write", app::pictureEndings());
  line.addFlag("window", "show the points in a window; needs a display").in(app::Group::output);
  line.exclude({"output", "window"}, true);
  line.addText("color",
               "elevation, intensity, strip, class, return, scan_angle, time, difference, "
               "or an extra-bytes field",
               "elevation");
  line.addText("reference_strip", "with -color difference: the strip to which heights refer")
      .formerly("reference");
  line.addNumber(
      "cell",
      "with -color difference: cell size of the planes of the reference strip; 0: by density", 0.0,
      {0.0, 1000.0, "m"});
  line.addText("color_map", "colour map: viridis, cividis, diverging, gray (default: by attribute)")
      .formerly("map");
  line.addText("color_range",
               "LOW:HIGH of the colours (default: 1st to 99th percentile of the points drawn)")
      .formerly("range");
  app::addWindowOptions(line).formerly("extent");
  app::addStripOptions(line);
  line.addNumber("azimuth", "viewing direction of the camera, clockwise from north", 0.0,
                 {-360.0, 360.0, "degrees"});
  line.addNumber("elevation", "height of the camera above the horizon; 90: top view", 90.0,
                 {0.0, 90.0, "degrees"});
  line.addNumber("zoom", "magnification about the centre", 1.0, {1e-3, 1e6});
  line.addChoice("shade", "none, edl (eye-dome lighting) or hill", {"none", "edl", "hill"}, "none");
  line.addNumber("point_size", "size of the points; 0: as large as the gaps between points", 0.0,
                 {0.0, 64.0, "pixels"});
  app::addSizeOption(line);
  line.addText("title", "text above (default: names of the files)").in(app::Group::output);
  line.addFlag("bare", "points only, without title, legend and scale");
  return line;
}

PointShade shadeOf(const CommandLine& line) {
  constexpr PointShade kShades[] = {PointShade::none, PointShade::eye_dome, PointShade::hill};
  return kShades[line.choice("shade")];
}

std::pair<double, double> rangeOf(const CommandLine& line) {
  const std::vector<double> range = app::numbersOf(line, "color_range", ':', 2, app::kFarthest);
  if (!(range[0] < range[1]))
    throw UsageError("option -color_range: LOW:HIGH needs LOW below HIGH");
  return {range[0], range[1]};
}

SurveyPictureOptions optionsOf(const CommandLine& line, const std::vector<std::string>& inputs) {
  SurveyPictureOptions options;
  const PictureSize size = app::sizeOf(line);
  options.width = size.width, options.height = size.height;
  options.attribute = line.text("color");
  if (line.has("reference_strip")) options.reference = line.text("reference_strip");
  options.difference_cell = line.number("cell");
  options.window = app::windowOf(line);
  options.strips = app::stripChoice(line);
  options.azimuth = line.number("azimuth");
  options.elevation = line.number("elevation");
  options.zoom = line.number("zoom");
  options.extent = options.window.bounds;
  if (line.has("color_map")) options.color_map = line.text("color_map");
  if (line.has("color_range")) options.range = rangeOf(line);
  options.shade = shadeOf(line);
  options.point_size = line.number("point_size");
  options.title = line.has("title") ? line.text("title") : fileNames(inputs);
  options.bare = line.has("bare");
  return options;
}

#if PCL_ALS_WITH_VTK
/// A window with the points, until it is closed.
class Window {
 public:
  Window() : display_(PointScene::connectToDisplay()) {
    if (display_ == nullptr) {
      throw InputError(
          "option -window: there is no display (DISPLAY is not set to one that answers); "
          "use -output");
    }
  }
  void show(const SurveyPicture& picture, double point_size) {
    const ColoredPoints points = picture.thinned();
    PointScene scene;
    scene.setBackground(ink::white);
    scene.setPointSize(std::max(1.0, point_size));
    scene.setPoints(points.positions, points.colors);
    scene.setCamera(picture.camera());
    scene.show("pcl_als_view");
  }

 private:
  std::shared_ptr<void> display_;  // a server may start anew after its last connection
};
#else
class Window {
 public:
  Window() { throw UsageError("option -window: built without VTK; use -output"); }
  void show(const SurveyPicture&, double) {}
};
#endif

int view(const CommandLine& line) {
  const auto& inputs = line.inputs();
  const SurveyPictureOptions options = optionsOf(line, inputs);
  std::unique_ptr<Window> window;
  if (line.has("window")) window = std::make_unique<Window>();
  const SurveyPicture picture(inputs, options, app::progressOf(line));
  if (window != nullptr) {
    window->show(picture, options.point_size);
    return app::kDone;
  }
  Step drawing("Drawing " + line.text("output"), line.quiet());
  picture.draw().write(line.text("output"));
  drawing.done(std::to_string(options.width) + " x " + std::to_string(options.height) + " pixels");
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, view);
}
