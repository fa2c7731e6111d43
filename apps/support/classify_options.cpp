// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "classify_options.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>

#include "picture_options.h"
#include "processes.h"
#include "strip_options.h"
#include "window_options.h"

namespace pcl_als::app {
namespace {

void addOutputs(CommandLine& line) {
  const OptionGroup group(line, Group::output);
  const std::vector<std::string> raster{".tif", ".tiff"};
  line.addOutputFile("output", "the map of classes; -grids may be written without it", raster);
  line.addOutputFile("grids", "also keep the rasters of the strips, in bands", raster);
  line.addOutputFile("posterior", "the posterior probability of the class of each cell", raster);
  line.addOutputFile("accuracy", "accuracy at the check points", {".json"});
  line.addOutputFile("checked", "the check points with their classes, for pcl_als_accuracy",
                     {".csv"});
  line.addOutputFile("save_class_model", "statistics of the classes for -class_model", {".json"})
      .formerly("save_model");
  line.addOutputFile("map", "picture of the map with its legend", pictureEndings());
  line.addInputFile("beside",
                    "another map of classes (GeoTIFF) that is drawn to the left of the map");
  line.addText("captions",
               "captions of -beside and of the map, separated by a comma (default: before,after)");
  addResumeOption(line);
  line.addOutputFolder(
          "classified",
          "folder for copies of the point files with ASPRS classes; noise (7, 18), "
          "points without a class and points of strips that are excluded keep their code",
          copiesOfInputs())
      .formerly("points");
  for (const char* name :
       {"posterior", "accuracy", "checked", "save_class_model", "map", "classified"})
    line.makeDependent(name, "output");
  for (const char* name : {"accuracy", "checked"}) line.makeDependent(name, "checkpoints");
  line.makeDependent("beside", "map");
}

/// How the rasters are made.
void addRasterOptions(CommandLine& line) {
  line.addChoice("interpolation", "interpolation of cells without points", {"tin", "idw"}, "tin");
  line.addNumber("surface_gap", "radius of the largest gap of the surface that is filled", 6.0,
                 {0.0, 1000.0, "m"});
  line.addNumber("terrain_gap", "the same for the terrain (houses, woods)", 30.0,
                 {0.0, 1000.0, "m"});
  line.addChoice("ground",
                 "terrain from points of ground classes (class) or by a "
                 "morphological filter (filter)",
                 {"class", "filter"}, "class");
  line.addText("ground_classes", "ASPRS classes that are ground", "2,9,11");
  line.addNumber("largest_object", "width of the widest building, for -ground filter", 40.0,
                 {1.0, 500.0, "m"});
  line.addNumber("texture_window", "side of the square of slope, roughness and returns", 2.5,
                 {0.0, 1000.0, "m"});
  line.addWhole("tile", "side of the tiles that are processed", 768, {64, 8192, "cells"});
}

}  // namespace

CommandLine declareClassify() {
  CommandLine line("pcl_als_classify",
                   "makes rasters of strips, classifies land cover by Gaussian maximum likelihood "
                   "and assesses its accuracy.",
                   "STRIP… -training CSV|GEOJSON [-checkpoints CSV] -cell M -output landcover.tif",
                   "pcl_als_classify strip*.las -training training.csv -checkpoints "
                   "checkpoints.csv -cell 0.5 -output landcover.tif -accuracy accuracy.json -map "
                   "landcover.png");
  line.setArguments({{"", 1, Arguments::kAnyNumber}});
  line.addInputFile("training", "training sites: CSV x,y,class or GeoJSON with property class");
  line.addInputFile("class_model",
                    "statistics of the classes from -save_class_model instead of training")
      .formerly("model");
  line.addInputFile("checkpoints", "check sites, as training");
  addUnitsOption(line, "sites", "-training and -checkpoints");
  addStripOptions(line);
  addOutputs(line);
  line.addNumber("cell", "side of the cells", 1.0, {0.01, 1000.0, "m"}).in(Group::output);
  line.addText(
          "bounds",
          "XMIN,YMIN,XMAX,YMAX, m: make rasters of this rectangle only (default: of all points)")
      .formerly("extent")
      .in(Group::output);
  line.addText("crs",
               "CRS of the rasters, which are georeferenced in its unit (default: that of the "
               "point files); heights are in metres")
      .in(Group::output);
  line.addText("bands",
               "bands by which classes are separated, from " +
                   joined(SurfaceAccumulator::bandNames()) +
                   "; echo_width: of points decomposed by pcl_als_waveform",
               "height,intensity,roughness,multiple_returns");
  line.addText("priors",
               "CLASS=P,…: probabilities of classes; the others share the rest (default: equal)")
      .in(Group::priors);
  line.addNumber("reject",
                 "probability of the chi-squared distribution below which a cell has no class", 0.0,
                 {0.0, 0.5});
  line.addNumber("training_radius",
                 "radius around a training point within which cells are training cells", 0.0,
                 {0.0, 1000.0, "m"});
  addRasterOptions(line);
  return line;
}

SurfaceOptions surfaceOptionsOf(const CommandLine& line) {
  SurfaceOptions options;
  if (line.choice("interpolation") == 1)
    options.interpolation = SurfaceOptions::Interpolation::inverse_distance;
  if (line.choice("ground") == 1) options.ground = SurfaceOptions::Ground::filtered;
  options.surface_gap = line.number("surface_gap");
  options.terrain_gap = line.number("terrain_gap");
  options.largest_object = line.number("largest_object");
  options.texture_window = line.number("texture_window");
  options.ground_classes = line.parsed("ground_classes", classCodesIn);
  return options;
}

RasterGrid gridOf(const CommandLine& line, double min_x, double min_y, double max_x, double max_y,
                  const std::string& crs) {
  const double cell = line.number("cell");
  if (!line.has("bounds")) return RasterGrid::covering(min_x, min_y, max_x, max_y, cell, crs);
  const Eigen::AlignedBox2d extent = rectangleOf(line, "bounds");
  // Edges that are multiples of the cell size give no further row or column.
  const double inner = 1e-6 * cell;
  return RasterGrid::covering(extent.min().x() + inner, extent.min().y() + inner,
                              extent.max().x() - inner, extent.max().y() - inner, cell, crs);
}

}  // namespace pcl_als::app
