// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <string>

#include <pcl_als/crs/crs.h>
#include <pcl_als/io/pulse_io.h>
#include <pcl_als/processing/simulated_survey.h>
#include <pcl_als/simulation/simulation_options.h>

#include "command_line.h"
#include "window_options.h"

namespace {

using namespace pcl_als;
using namespace pcl_als::app;
using simulation::NoiseOptions;
using simulation::SimulationOptions;

void declareScene(CommandLine& line) {
  line.addFlag("images",
               "also images of the block with a frame camera, in the folder images: camera.json, "
               "images.csv, measurements.csv, checkpoints.csv and the truth")
      .in(Group::output);
  line.addWhole("target_count", "number of white level circular targets in control.csv", 0,
                {0, 1000, {}})
      .formerly("targets");
  line.addNumber("target_diameter", "diameter of the targets", 2.0, {0.1, 20.0, "m"});
  line.addNumber("relief", "factor on the heights of the terrain; 0: a plane", 1.0, {0.0, 1.5});
  line.addNumber("buildings", "factor on their number", 1.0, {0.0, 1.0});
  line.addNumber("trees", "factor on their number", 1.0, {0.0, 4.0});
  line.addNumber("grass", "largest height of the blades of grass, which pulses meet at all heights",
                 0.0, {0.0, 1.0, "m"});
}

void addNoise(CommandLine& line) {
  line.addText(
      "noise",
      "none; range: 2 cm; realistic: also encoder, refractive index, footprint, intensity, "
      "control and slowly drifting trajectory errors",
      "none");
  line.addText("ins",
               "trajectory errors of a GNSS/INS in place of those of -noise: survey (2 cm, 9\" "
               "roll and pitch, 18\" heading), tactical (3 cm, 54\", 126\"), mems (4 cm, 90\", "
               "288\")");
  line.addText(
      "error_process",
      "process of the trajectory errors: gauss_markov (correlation time 20 s, of -ins 20 to 60 s), "
      "band_limited (smooth, periods of 0.6 to 5 times that), random_walk, drift (a constant and a "
      "linear change in each line), white, jumps",
      "gauss_markov");
  line.addTexts(
      "error",
      "[channelN:|sessionN:|stripN:]NAME=VALUE: further errors (assumed - true): time_offset "
      "(ms), mirror_torsion (arcsec), encoder_quadratic, encoder_cubic (1/rad, 1/rad2), "
      "encoder_sine (arcsec, period 10 degrees), "
      "deflection_scale, range_scale (1), range_walk (m per decade of intensity), "
      "range_incidence (share of the stretched pulse), offset_x/_y/_z, jump_x/_y/_z in the "
      "middle of a strip (m), and every name of -bias of one channel (from 0), session or "
      "strip");
  line.addWhole("sessions", "number of days on which the lines are flown", 1, {1, 5, {}});
}

void addPointOptions(CommandLine& line) {
  line.addNumber("gain",
                 "digital number of a white target at 1000 m in vacuum, under 70: 8-bit; 0: the "
                 "preset's, 10000 and in low flights 100 to 400",
                 0.0, {0.0, 1e7});
  line.addText("strip_gains", "ID=FACTOR,…: factors on the gain of single lines, 0.01 to 100");
  line.addNumber("range_exponent", "power of the range with which intensity decreases", 2.0,
                 {0.0, 4.0});
  line.addNumber("incidence_exponent", "power of cos(incidence); 1: Lambertian", 1.0, {0.0, 4.0});
  line.addNumber("divergence", "divergence of the beam, between its 1/e^2 points", 0.33,
                 {0.0, 10.0, "mrad"});
  line.addNumber("visibility", "visibility", 48.3, {0.1, 500.0, "km"});
  line.addChoice("format", "format of the strips", {"las", "laz"}, "las").in(Group::output);
}

void declareWaveforms(CommandLine& line) {
  line.addFlag("waveforms",
               "record the waveforms of all pulses by sub-rays over their footprint, in strip1.wdp "
               "… beside the strips; the returns are those that a detector finds in them")
      .in(Group::output);
  line.addChoice("waveform_format",
                 "point format of strips with waveforms: 4 and 5 are LAS 1.3, 9 and 10 LAS 1.4",
                 {"4", "5", "9", "10"}, "9")
      .in(Group::output);
  line.addNumber("sample_spacing", "time between samples", 1.0, {0.05, 100.0, "ns"});
  line.addWhole("sample_bits", "bits of a sample", 12, {4, 16, {}});
  line.addNumber("sample_noise",
                 "standard deviation of a sample as share of the largest that its bits hold", 0.001,
                 {0.0, 0.2});
  line.addNumber("pulse_width", "full width at half maximum of the emitted pulse", 4.0,
                 {0.1, 100.0, "ns"});
  line.addNumber("pulse_skewness", "skewness of the emitted pulse; 0: Gaussian", 0.0, {0.0, 1.5});
  line.addInputFile("pulse",
                    "the emitted pulse by samples: CSV time_ns,value, evenly spaced, with a "
                    "baseline of zero");
  for (const char* name : {"waveform_format", "sample_spacing", "sample_bits", "sample_noise",
                           "pulse_width", "pulse_skewness", "pulse"})
    line.makeDependent(name, "waveforms");
  line.exclude({"pulse", "pulse_width"});
  line.exclude({"pulse", "pulse_skewness"});
}

/// What is known of each point of a simulation.
void declareTruth(CommandLine& line) {
  line.addFlag("truth_points",
               "extra bytes bias_x, bias_y, bias_z: effect of biases and errors on each point, m")
      .in(Group::output);
  line.addFlag("true_surface",
               "extra bytes error_x, error_y, error_z: each point minus that of the true surface, "
               "m: biases, errors of the trajectory and noise")
      .in(Group::output);
}

std::vector<std::string> outputFiles() {
  std::vector<std::string> files{"strip*.las",  "strip*.laz",   "strip*.wdp",      "trajectory.csv",
                                 "control.csv", "training.csv", "checkpoints.csv", "truth.json"};
  for (const char* name : {"camera.json", "images.csv", "measurements.csv", "checkpoints.csv",
                           "true_images.csv", "true_points.csv", "true_lines.csv"})
    files.push_back(std::string("images/") + name);
  return files;
}

CommandLine declare() {
  CommandLine line("pcl_als_simulate",
                   "simulates an airborne laser scanning block with known system biases.",
                   "-output DIR [-preset NAME] [-noise none|range|realistic] [-bias …] [-error …]",
                   "pcl_als_simulate -output block -preset small -noise range -seed 3 "
                   "-bias boresight_roll=60,range_bias=0.1");
  line.addOutputFolder("output",
                       "folder for strip1.las …, trajectory.csv, control.csv, training.csv, "
                       "checkpoints.csv and truth.json; made if missing",
                       always(outputFiles()))
      .needed();
  line.addText(
      "preset",
      "paper (six lines at 1150 m and 540 m, 11 million points), small (0.9 million), uav (drone "
      "at 75 m), corridor (helicopter at 200 m, strips that overlap at their ends), conical, dual "
      "(looking ahead and back), rosette (drone at 70 m), mountain (relief of 400 m), city (blocks "
      "of 12 to 90 m)",
      "paper");
  line.addText("scanner",
               "in place of the preset's: oscillating, polygon, conical, rosette, dual, cross "
               "(two channels, crossing lines), multi (spinning, 16 channels; multi:32)");
  line.addNumber("scale", "factor on the lengths of the lines", 1.0, {0.05, 10.0});
  line.addNumber("density", "factor on the pulses per square metre", 1.0, {0.01, 50.0});
  line.addNumber("height", "factor on the flying heights", 1.0, {0.1, 10.0});
  line.addWhole("seed", "seed of scene, flight and noise", 1, {0, 18446744073709551615.0, {}});
  addNoise(line);
  line.addText("bias",
               "NAME=VALUE,…: assumed - true in m, arcsec or 1, names as in calibration.json; "
               "replaces the preset's lever_arm_x=0.05, lever_arm_y=-0.05, "
               "boresight_pitch=-30, boresight_roll=-90, boresight_heading=40, "
               "range_bias=0.12, scan_angle_scale=1e-4 (conical, rosette: 0); 'none' sets all "
               "to zero, also as first entry");
  line.addFlag("vertical", "flight without attitude motion and crab");
  line.addNumber("fov", "full field of view; 0: the preset's, 40 to 70", 0.0,
                 {0.0, 90.0, "degrees"});
  line.addText("origin",
               "X,Y,Z: ground coordinates of the block's middle, m (default: "
               "700000,5660000,1000)");
  line.addText("crs",
               "CRS written to the strips, whose coordinates are in its unit; trajectory, "
               "control and sites are in metres",
               "EPSG:32611");
  declareScene(line);
  line.addChoice("time",
                 "times of the points: week (seconds) or adjusted (standard GPS time); the "
                 "trajectory has seconds of the week",
                 {"week", "adjusted"}, "week")
      .in(Group::output);
  declareTruth(line);
  addPointOptions(line);
  declareWaveforms(line);
  return line;
}

void setIntensity(const CommandLine& line, SimulationOptions& options) {
  const double gain = line.number("gain");
  if (gain > 0.0) options.scanner.gain = gain;
  options.scanner.range_exponent = line.number("range_exponent");
  options.scanner.incidence_exponent = line.number("incidence_exponent");
  options.atmosphere.visibility_km = line.number("visibility");
  if (line.has("strip_gains")) options.setGains(line.text("strip_gains"));
}

simulation::WaveformOptions waveformsFrom(const CommandLine& line) {
  simulation::WaveformOptions waveform;
  waveform.sample_spacing = line.number("sample_spacing");
  waveform.bits = static_cast<int>(line.whole("sample_bits"));
  waveform.noise = line.number("sample_noise");
  waveform.pulse_width = line.number("pulse_width");
  waveform.pulse_skewness = line.number("pulse_skewness");
  if (line.has("pulse")) {
    const PulseSamples pulse = readPulse(line.text("pulse"));
    waveform.pulse = pulse.values;
    waveform.pulse_spacing = pulse.spacing_ns;
  }
  return waveform;
}

SimulationOptions optionsFrom(const CommandLine& line) {
  auto options =
      SimulationOptions::preset(line.text("preset"), line.number("scale"), line.number("density"),
                                line.number("fov") * kRadiansPerDegree, line.number("height"));
  if (line.has("scanner")) options.setScanner(line.text("scanner"));
  options.scanner.divergence = 1e-3 * line.number("divergence");
  options.seed = line.whole("seed");
  options.noise = NoiseOptions::named(line.text("noise"));
  if (line.has("ins")) options.noise.setTrajectoryGrade(line.text("ins"));
  options.setSessions(static_cast<int>(line.whole("sessions")));
  if (line.has("error")) options.errors.add(line.text("error"));
  options.noise.process = simulation::errorProcessNamed(line.text("error_process"));
  if (line.has("bias")) simulation::setBiases(line.text("bias"), options.bias);
  options.vertical = line.has("vertical");
  if (line.has("origin"))
    options.origin = Eigen::Vector3d(numbersOf(line, "origin", ',', 3, kFarthest).data());
  options.crs = line.text("crs");
  requireProjectedCrs(options.crs, "option -crs");
  options.scene.relief *= line.number("relief");
  options.scene.buildings = line.number("buildings");
  options.scene.trees = line.number("trees");
  options.scene.grass = line.number("grass");
  options.targets = static_cast<int>(line.whole("target_count"));
  options.target_diameter = line.number("target_diameter");
  setIntensity(line, options);
  if (line.has("waveforms")) options.waveform = waveformsFrom(line);
  options.check();
  return options;
}

int simulate(const CommandLine& line) {
  const SimulationOptions options = optionsFrom(line);
  StripFileOptions files;
  files.adjusted_time = line.choice("time") == 1;
  files.compressed = line.choice("format") == 1;
  files.bias_columns = line.has("truth_points");
  files.error_columns = line.has("true_surface");
  files.images = line.has("images");
  files.waveform_format = std::stoi(line.text("waveform_format"));
  files.folder = line.text("output");
  simulateSurvey(options, line.text("noise"), files, line.threads(), progressOf(line));
  return kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, declare, simulate);
}
