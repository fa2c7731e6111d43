// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/processing/simulated_survey.h>
#include <pcl_als/simulation/simulation_options.h>

#include "command_line.h"
#include "output_check.h"
#include "window_options.h"

namespace {

using namespace pcl_als;
using namespace pcl_als::app;
using simulation::NoiseOptions;
using simulation::SimulationOptions;

void declareScene(CommandLine& line) {
  line.addFlag("images",
               "also images of the block with a frame camera, in the folder images: camera.json, "
               "images.csv, measurements.csv, checkpoints.csv and the truth");
  line.add<int>("targets", "number of white level circular targets in control.csv, 0 to 1000", 0);
  line.add<double>("target_diameter", "diameter of the targets, m", 2.0);
  line.add<double>("relief", "factor on the heights of the terrain, 0 (plane) to 1.5", 1.0);
  line.add<double>("buildings", "factor on their number, 0 to 1", 1.0);
  line.add<double>("trees", "factor on their number, 0 to 4", 1.0);
}

void addNoise(CommandLine& line) {
  line.add<std::string>(
      "noise",
      "none; range: 2 cm; realistic: also encoder, refractive index, footprint, intensity, "
      "control and slowly drifting trajectory errors",
      "none");
  line.addOptional("ins",
                   "trajectory errors of a GNSS/INS in place of those of -noise: survey (2 cm, 9\" "
                   "roll and pitch, 18\" heading), tactical (3 cm, 54\", 126\"), mems (4 cm, 90\", "
                   "288\")");
  line.add<std::string>(
      "error_process",
      "process of the trajectory errors: gauss_markov (correlation time 20 s, of -ins 20 to 60 s), "
      "band_limited (smooth, periods of 0.6 to 5 times that), random_walk, drift (a constant and a "
      "linear change in each line), white, jumps",
      "gauss_markov");
  line.addList(
      "error",
      "[channelN:|sessionN:|stripN:]NAME=VALUE: further errors (assumed - true): time_offset "
      "(ms), mirror_torsion (arcsec), encoder_quadratic, encoder_cubic (1/rad, 1/rad2), "
      "deflection_scale, range_scale (1), range_walk (m per decade of intensity), "
      "range_incidence (share of the stretched pulse), offset_x/_y/_z, jump_x/_y/_z in the "
      "middle of a strip (m), and every name of -bias of one channel (from 0), session or "
      "strip");
  line.add<int>("sessions", "number of days on which the lines are flown, 1 to 5", 1);
}

CommandLine declare() {
  CommandLine line("pcl_als_simulate",
                   "simulates an airborne laser scanning block with known system biases.",
                   "-output DIR [-preset NAME] [-noise none|range|realistic] [-bias …] [-error …]",
                   "pcl_als_simulate -output block -preset small -noise range -seed 3 "
                   "-bias boresight_roll=60,range_bias=0.1");
  line.addNeeded("output",
                 "folder for strip1.las …, trajectory.csv, control.csv, training.csv, "
                 "checkpoints.csv and truth.json; made if missing");
  line.add<std::string>(
      "preset",
      "paper (six lines at 1150 m and 540 m, 11 million points), small (0.9 million), uav (drone "
      "at 75 m), corridor (helicopter at 200 m, strips that overlap at their ends), conical, dual "
      "(looking ahead and back), rosette (drone at 70 m), mountain (relief of 400 m), city (blocks "
      "of 12 to 90 m)",
      "paper");
  line.addOptional("scanner",
                   "in place of the preset's: oscillating, polygon, conical, rosette, dual, cross "
                   "(two channels, crossing lines), multi (spinning, 16 channels; multi:32)");
  line.add<double>("scale", "factor on the lengths of the lines, 0.05 to 10", 1.0);
  line.add<double>("density", "factor on the pulses per square metre, 0.01 to 50", 1.0);
  line.add<double>("height", "factor on the flying heights, 0.1 to 10", 1.0);
  line.add<std::string>("seed", "seed of scene, flight and noise", "1");
  addNoise(line);
  line.addOptional("bias",
                   "NAME=VALUE,…: assumed - true in m, arcsec or 1, names as in calibration.json; "
                   "replaces the preset's lever_arm_x=0.05, lever_arm_y=-0.05, "
                   "boresight_pitch=-30, boresight_roll=-90, boresight_heading=40, "
                   "range_bias=0.12, scan_angle_scale=1e-4 (conical, rosette: 0); 'none' sets all "
                   "to zero, also as first entry");
  line.addFlag("vertical", "flight without attitude motion and crab");
  line.add<double>("fov", "full field of view, degrees, to 90; 0: the preset's, 40 to 70", 0.0);
  line.addOptional("origin",
                   "X,Y,Z: ground coordinates of the block's middle, m (default: "
                   "700000,5660000,1000)");
  line.add<std::string>("crs",
                        "CRS written to the strips, whose coordinates are in its unit; trajectory, "
                        "control and sites are in metres",
                        "EPSG:32611");
  declareScene(line);
  line.add<std::string>("time",
                        "times of the points: week (seconds) or adjusted (standard GPS time); the "
                        "trajectory has seconds of the week",
                        "week");
  line.addFlag("truth_points",
               "extra bytes bias_x, bias_y, bias_z: effect of biases and errors on each point, m");
  line.add<double>("gain",
                   "digital number of a white target at 1000 m in vacuum, under 70: 8-bit; 0: the "
                   "preset's, 10000 and in low flights 100 to 400",
                   0.0);
  line.addOptional("strip_gains", "ID=FACTOR,…: factors on the gain of single lines, 0.01 to 100");
  line.add<double>("range_exponent", "power of the range with which intensity decreases", 2.0);
  line.add<double>("incidence_exponent", "power of cos(incidence); 1: Lambertian", 1.0);
  line.add<double>("visibility", "visibility, km", 48.3);
  line.add<std::string>("format", "format of the strips: las or laz", "las");
  return line;
}

void setIntensity(const CommandLine& line, SimulationOptions& options) {
  const double gain = line.number("gain", 0.0, 1e7, "(digital number)");
  if (gain > 0.0) options.scanner.gain = gain;
  options.scanner.range_exponent = line.number("range_exponent", 0.0, 4.0, "(exponent)");
  options.scanner.incidence_exponent = line.number("incidence_exponent", 0.0, 4.0, "(exponent)");
  options.atmosphere.visibility_km = line.number("visibility", 0.1, 500.0, "km");
  if (line.has("strip_gains")) options.setGains(line.text("strip_gains"));
}

SimulationOptions optionsFrom(const CommandLine& line) {
  auto options =
      SimulationOptions::preset(line.text("preset"), line.number("scale", 0.05, 10.0, "(factor)"),
                                line.number("density", 0.01, 50.0, "(factor)"),
                                line.number("fov", 0.0, 90.0, "degrees") * kRadiansPerDegree,
                                line.number("height", 0.1, 10.0, "(factor)"));
  if (line.has("scanner")) options.setScanner(line.text("scanner"));
  options.seed = line.wholeNumber("seed");
  options.noise = NoiseOptions::named(line.text("noise"));
  if (line.has("ins")) options.noise.setTrajectoryGrade(line.text("ins"));
  options.setSessions(line.get<int>("sessions"));
  if (line.has("error")) options.errors.add(line.text("error"));
  options.noise.process = simulation::errorProcessNamed(line.text("error_process"));
  if (line.has("bias")) simulation::setBiases(line.text("bias"), options.bias);
  options.vertical = line.has("vertical");
  if (line.has("origin"))
    options.origin = Eigen::Vector3d(numbersOf(line, "origin", ',', 3, kFarthest).data());
  options.crs = line.text("crs");
  requireProjectedCrs(options.crs, "option -crs");
  options.scene.relief *= line.number("relief", 0.0, 1.5, "(factor)");
  options.scene.buildings = line.number("buildings", 0.0, 1.0, "(factor)");
  options.scene.trees = line.number("trees", 0.0, 4.0, "(factor)");
  options.targets = static_cast<int>(line.whole("targets", 0, 1000));
  options.target_diameter = line.number("target_diameter", 0.1, 20.0, "m");
  setIntensity(line, options);
  options.check();
  return options;
}

int simulate(const CommandLine& line) {
  line.inputs(0, 0);
  const SimulationOptions options = optionsFrom(line);
  StripFileOptions files;
  files.adjusted_time = line.choice("time", {"week", "adjusted"}) == 1;
  files.compressed = line.choice("format", {"las", "laz"}) == 1;
  files.bias_columns = line.has("truth_points");
  files.images = line.has("images");
  files.folder = line.text("output");
  makeOutputFolder("output", files.folder);
  simulateSurvey(options, line.text("noise"), files, line.threads(), progressOf(line));
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, declare, simulate);
}
