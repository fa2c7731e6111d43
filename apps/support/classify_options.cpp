// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "classify_options.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>

#include "processes.h"
#include "strip_options.h"
#include "window_options.h"

namespace pcl_als::app {
namespace {

void addOutputs(CommandLine& line) {
  line.addOptional("output",
                   "the map of classes, GeoTIFF (needed, unless -grids alone is written)");
  line.addOptional("grids", "also keep the rasters of the strips, GeoTIFF of nine bands");
  line.addOptional("posterior", "the posterior probability of the class of each cell, GeoTIFF");
  line.addOptional("accuracy", "accuracy at the check points, JSON");
  line.addOptional("checked", "the check points with their classes, CSV for pcl_als_accuracy");
  line.addOptional("save_model", "statistics of the classes, JSON for -model");
  line.addOptional("map", "picture of the map with its legend, PNG");
  line.addOptional("beside",
                   "another map of classes (GeoTIFF) that is drawn to the left of the map");
  line.addOptional(
      "captions",
      "captions of -beside and of the map, separated by a comma (default: before,after)");
  addResumeOption(line);
  line.addOptional("points",
                   "folder for copies of the point files with ASPRS classes; noise (7, 18), points "
                   "without a class and points of strips that are left out keep their code");
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
  line.addOptional("training", "training sites: CSV x,y,class or GeoJSON with property class");
  line.addOptional("model", "statistics of the classes from -save_model instead of training");
  line.addOptional("checkpoints", "check sites, as training");
  addUnitsOption(line, "sites", "-training and -checkpoints");
  addStripOptions(line);
  addOutputs(line);
  line.add<double>("cell", "side of the cells, m", 1.0);
  line.addOptional("extent", "WEST,SOUTH,EAST,NORTH of the rasters, m (default: all points)");
  line.addOptional("crs",
                   "CRS of the rasters, which are georeferenced in its unit (default: that of the "
                   "point files); heights are in metres");
  line.add<std::string>("bands",
                        "bands by which classes are separated, from surface, terrain, height, "
                        "intensity, slope, roughness, multiple_returns, height_range, density",
                        "height,intensity,roughness,multiple_returns");
  line.addOptional(
      "priors", "CLASS=P,…: probabilities of classes; the others share the rest (default: equal)");
  line.add<double>(
      "reject",
      "probability of the chi-squared distribution below which a cell has no class, 0 to 0.5", 0.0);
  line.add<double>("training_radius",
                   "radius around a training point within which cells are training cells, m", 0.0);
  line.add<std::string>("interpolation", "interpolation of cells without points: tin or idw",
                        "tin");
  line.add<double>("surface_gap", "radius of the largest gap of the surface that is filled, m",
                   6.0);
  line.add<double>("terrain_gap", "the same for the terrain (houses, woods), m", 30.0);
  line.add<std::string>("ground",
                        "terrain from points of ground classes (class) or by a "
                        "morphological filter (filter)",
                        "class");
  line.add<std::string>("ground_classes", "ASPRS classes that are ground", "2,9,11");
  line.add<double>("largest_object", "width of the widest building, for -ground filter, m", 40.0);
  line.add<double>("texture_window", "side of the square of slope, roughness and returns, m", 2.5);
  line.add<double>("tile", "side of the tiles that are processed, cells, 64 to 8192", 768.0);
  return line;
}

SurfaceOptions surfaceOptionsOf(const CommandLine& line) {
  SurfaceOptions options;
  if (line.choice("interpolation", {"tin", "idw"}) == 1)
    options.interpolation = SurfaceOptions::Interpolation::inverse_distance;
  if (line.choice("ground", {"class", "filter"}) == 1)
    options.ground = SurfaceOptions::Ground::filtered;
  options.surface_gap = line.number("surface_gap", 0.0, 1000.0, "m");
  options.terrain_gap = line.number("terrain_gap", 0.0, 1000.0, "m");
  options.largest_object = line.number("largest_object", 1.0, 500.0, "m");
  options.texture_window = line.number("texture_window", 0.0, 1000.0, "m");
  options.ground_classes = line.parsed("ground_classes", classCodesIn);
  return options;
}

RasterGrid gridOf(const CommandLine& line, double min_x, double min_y, double max_x, double max_y,
                  const std::string& crs) {
  const double cell = line.number("cell", 0.01, 1000.0, "m");
  if (!line.has("extent")) return RasterGrid::covering(min_x, min_y, max_x, max_y, cell, crs);
  const Eigen::AlignedBox2d extent = rectangleOf(line, "extent");
  // Edges that are multiples of the cell size give no further row or column.
  const double inner = 1e-6 * cell;
  return RasterGrid::covering(extent.min().x() + inner, extent.min().y() + inner,
                              extent.max().x() - inner, extent.max().y() - inner, cell, crs);
}

}  // namespace pcl_als::app
