// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iostream>
#include <limits>

#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/processing/picture/picture_source.h>
#include <pcl_als/visualization/point_picture.h>
#include <pcl_als/visualization/point_scene.h>
#include <pcl_als/visualization/private_display.h>
#include <pcl_als/visualization/ticks.h>
#include <pcl_als/visualization/voxel_thinning.h>

#include "command_line.h"
#include "picture_options.h"
#include "strip_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;

CommandLine commandLine() {
  CommandLine line("pcl_als_view",
                   "draws point files to a PNG, from above or obliquely, or shows them in a window",
                   "FILE... -output PICTURE.png [options]",
                   "pcl_als_view strip*.las -output strips.png -color strip -shade edl");
  line.addOptional("output", "PNG to write (needed unless -window is given)");
  line.addFlag("window", "show the points in a window; needs a display");
  line.add<std::string>("color",
                        "elevation, intensity, strip, class, return, scan_angle, time, difference, "
                        "or an extra-bytes field",
                        "elevation");
  line.addOptional("reference", "with -color difference: the strip that heights are above");
  line.add("cell", "with -color difference: cells of the reference's planes, m; 0: by density",
           0.0);
  line.addOptional("map", "colour map: viridis, cividis, diverging, gray (default: by attribute)");
  line.addOptional("range",
                   "LOW:HIGH of the colours (default: 1st to 99th percentile of what is "
                   "shown)");
  app::addStripOptions(line);
  line.add("azimuth", "direction the camera looks to, degrees clockwise from north", 0.0);
  line.add("elevation", "height of the camera above the horizon, degrees; 90: top view", 90.0);
  line.add("zoom", "enlarges about the middle", 1.0);
  line.addOptional("extent", "XMIN,YMIN,XMAX,YMAX: draw this part only, m");
  line.add<std::string>("shade", "none, edl (eye-dome lighting) or hill", "none");
  line.add("point_size", "pixels; 0: as large as the gaps between points", 0.0);
  app::addSizeOption(line);
  line.addOptional("title", "text above (default: names of the files)");
  line.addFlag("bare", "points only, without title, legend and scale");
  return line;
}

PointShade shadeOf(const CommandLine& line) {
  const std::string name = line.text("shade");
  if (name == "none") return PointShade::none;
  if (name == "edl") return PointShade::eye_dome;
  if (name == "hill") return PointShade::hill;
  throw UsageError("option -shade: '" + name + "' is none of none, edl, hill");
}

/// What of the points is drawn.
struct Selection {
  std::vector<bool> strips;  ///< chosen
  int hidden = -1;           ///< not drawn
  bool cut = false;
  Eigen::Vector2d low, high;

  bool operator()(const PictureSource::Point& point) const {
    if (point.strip == hidden || !strips[static_cast<std::size_t>(point.strip)]) return false;
    if (!cut) return true;
    return (point.position.head<2>().array() >= low.array()).all() &&
           (point.position.head<2>().array() <= high.array()).all();
  }
};

Selection selectionOf(const CommandLine& line, const PictureSource& source,
                      const PointAttribute& attribute) {
  Selection selection;
  selection.strips = chosenStrips(app::stripChoice(line), source.strips());
  if (!line.has("strips")) selection.hidden = attribute.hiddenStrip();
  if (line.has("extent")) {
    const std::vector<double> edges = app::numbersOf(line, "extent", ',', 4);
    selection.cut = true;
    selection.low = {edges[0], edges[1]};
    selection.high = {edges[2], edges[3]};
    if (!(edges[0] < edges[2] && edges[1] < edges[3])) {
      throw UsageError("option -extent: XMIN,YMIN,XMAX,YMAX needs the smaller values first");
    }
  }
  return selection;
}

/// What the camera has to show: the points, or in a top view the whole of the extent.
ViewExtent extentOf(const OrthographicCamera& camera, const PictureSource& source,
                    const Selection& selection) {
  ViewExtent extent;
  extent.reference = 0.5 * (source.minimum() + source.maximum());
  source.read([&](const PictureSource::Point& point) {
    if (selection(point)) camera.add(point.position, extent);
  });
  if (extent.empty()) {
    throw InputError("no point to draw: the files cover " +
                     app::extentText(source.minimum(), source.maximum()));
  }
  if (selection.cut && camera.isTopView()) {
    extent.low.head<2>() = selection.low - extent.reference.head<2>();
    extent.high.head<2>() = selection.high - extent.reference.head<2>();
  }
  return extent;
}

void setScale(const CommandLine& line, const PixelThinning& points, bool symmetric,
              PointColoring& coloring) {
  if (line.has("map")) coloring.map = ColorMap::named(line.text("map"));
  if (!line.has("range")) {
    coloring.fitScale(points, symmetric ? 0.05 : 0.01, symmetric);
    return;
  }
  const std::vector<double> range = app::numbersOf(line, "range", ':', 2);
  if (!(range[0] < range[1])) throw UsageError("option -range: LOW:HIGH needs LOW below HIGH");
  coloring.low = range[0];
  coloring.high = range[1];
}

void showWindow(const CommandLine& line, const PictureSource& source, const Selection& selection,
                const PointAttribute& attribute, const PixelThinning& points,
                const PointColoring& coloring) {
  if (!PrivateDisplay::answers(std::getenv("DISPLAY") == nullptr ? "" : std::getenv("DISPLAY"))) {
    throw InputError(
        "option -window: there is no display (DISPLAY is not set to one that answers); "
        "use -output");
  }
  VoxelThinning voxels(points.camera().center(), source.maximum() - source.minimum());
  source.read(
      [&](const PictureSource::Point& point) {
        if (selection(point)) voxels.add(point.position, attribute.valueOf(point));
      },
      attribute.extraField());
  std::vector<Color> colors;
  for (const float value : voxels.values()) colors.push_back(coloring(value));
  PointScene scene;
  scene.setBackground(ink::white);
  scene.setPointSize(std::max(1.0, line.get<double>("point_size")));
  scene.setPoints(voxels.positions(), colors);
  scene.setCamera(points.camera());
  scene.show("pcl_als_view");
}

int view(int argc, char** argv) {
  CommandLine line = commandLine();
  if (!line.parse(argc, argv)) return app::kDone;
  const auto& inputs = line.inputs(1, 100000);
  const PictureSize size = app::sizeOf(line);
  OrthographicCamera camera(line.get<double>("azimuth"), line.get<double>("elevation"));
  const double zoom = line.number("zoom", 1e-3, 1e6, "times");
  PointPicture picture(size.width, size.height, line.has("bare"));
  picture.setShade(shadeOf(line));
  picture.setPointSize(line.number("point_size", 0.0, 64.0, "pixels"));
  const double cell = line.number("cell", 0.0, 1000.0, "m");
  if (line.has("map")) ColorMap::named(line.text("map"));
  if (line.has("output") == line.has("window")) {
    throw UsageError("one of -output PICTURE.png and -window is needed");
  }
  if (line.has("output")) app::pictureFile(line);

  Step step("Reading " + counted(inputs.size(), "file"), line.quiet());
  const PictureSource source(inputs, line.has("split"));
  PointAttribute attribute(line.text("color"), source,
                           line.has("reference") ? line.text("reference") : "");
  const Selection selection = selectionOf(line, source, attribute);
  attribute.prepare(cell);
  camera.frame(extentOf(camera, source, selection), picture.mapWidth(), picture.mapHeight(), zoom);
  PixelThinning points(camera);
  source.read(
      [&](const PictureSource::Point& point) {
        if (selection(point)) points.add(point.position, attribute.valueOf(point));
      },
      attribute.extraField());
  if (points.seen() == 0) throw InputError("no point lies in the picture");
  PointColoring coloring = attribute.coloring();
  if (coloring.categories.empty()) {
    setScale(line, points, attribute.symmetric(), coloring);
  } else {
    coloring.keepShown(points);
  }
  step.done(
      grouped(source.pointCount()) + " points, " + grouped(points.seen()) + " in the picture, " +
      grouped(points.shown()) + " shown" +
      (points.invalid() > 0 ? ", " + grouped(points.invalid()) + " without coordinates" : ""));
  app::remarks(line, source.remarks());
  if (line.has("window")) {
    showWindow(line, source, selection, attribute, points, coloring);
    return app::kDone;
  }
  Step drawing("Drawing " + line.text("output"), line.quiet());
  picture.setTitle(line.has("title") ? line.text("title") : app::namesOf(inputs));
  picture.setSubtitle(countText(points.seen()) + " points");
  const PrivateDisplay display;
  writePng(line.text("output"), picture.draw(points, coloring).image());
  drawing.done(std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels" +
               (display.isPrivate() ? ", private display" : ""));
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run("pcl_als_view", [argc, argv] { return view(argc, argv); });
}
