// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "adjustment_options.h"

#include <algorithm>

#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/errors.h>

#include "flight_options.h"

namespace pcl_als::app {

void addErrorOptions(CommandLine& line) {
  const CalibrationSettings defaults;
  line.add("range_noise", "standard deviation of ranges, m", defaults.noise.range);
  line.add("angle_noise", "standard deviation of pointing, arcsec",
           defaults.noise.angle / kRadiansPerArcsec);
  line.add("beam_divergence", "full divergence of the beam at 1/e^2, mrad",
           1e3 * defaults.noise.beam_divergence);
  line.addOptional("ins",
                   "grade of the GNSS/INS, whose data sheet gives the three standard deviations "
                   "that follow: survey, tactical or mems (0.04 m, 90\", 288\")");
  line.add("position_sigma", "prior standard deviation of trajectory errors: position, m",
           defaults.shared_errors.position);
  line.add("roll_pitch_sigma",
           "prior standard deviation of trajectory errors: roll and pitch, arcsec",
           defaults.shared_errors.roll_pitch / kRadiansPerArcsec);
  line.add("heading_sigma", "prior standard deviation of trajectory errors: heading, arcsec",
           defaults.shared_errors.heading / kRadiansPerArcsec);
  line.add("control_sigma", "standard deviation of control points whose file gives none, m",
           defaults.control_sigma);
}

NoiseModel noiseOf(const CommandLine& line) {
  NoiseModel noise;
  noise.range = line.number("range_noise", 1e-4, 1.0, "m");
  noise.angle = line.number("angle_noise", 0.0, 1000.0, "arcsec") * kRadiansPerArcsec;
  noise.beam_divergence = 1e-3 * line.number("beam_divergence", 0.0, 10.0, "mrad");
  return noise;
}

SharedErrorModel sharedErrorsOf(const CommandLine& line) {
  SharedErrorModel shared;
  if (line.has("ins")) shared = line.parsed("ins", SharedErrorModel::ofGrade);
  const auto set = [&line](const char* name, double low, double high, const char* unit, double by,
                           double& value) {
    const double given = line.number(name, low, high, unit) * by;
    if (!line.has("ins") || line.given(name)) value = given;
  };
  set("position_sigma", 1e-5, 10.0, "m", 1.0, shared.position);
  set("roll_pitch_sigma", 0.01, 10000.0, "arcsec", kRadiansPerArcsec, shared.roll_pitch);
  set("heading_sigma", 0.01, 10000.0, "arcsec", kRadiansPerArcsec, shared.heading);
  return shared;
}

void addEstimateOption(CommandLine& line, const std::string& subject) {
  const std::string help =
      "parameters to estimate, e.g. boresight_roll,range_bias; auto: all that " + subject;
  line.add<std::string>("estimate", help.c_str(), "auto");
}

std::vector<SystemParameter> parametersToEstimate(const CommandLine& line) {
  if (line.text("estimate") == "auto") return {};
  return line.parsed("estimate", systemParametersIn);
}

void addSystemOptions(CommandLine& line) {
  line.addList("system",
               "NAME=STRIPS[:CHANNEL] ...: systems with biases of their own, e.g. north=1-4 "
               "south=5-9, or a=1-9:0 b=1-9:1 with -channels; strips that none names are of the "
               "first one");
  line.addOptional(
      "fixed",
      "strips that are held fixed, e.g. 1,4-6: an earlier delivery, already corrected, "
      "that the block joins; they are not corrected");
  line.add("fixed_sigma",
           "standard deviation of an error that all fixed strips share, each axis, m",
           CalibrationSettings().fixed_sigma);
  line.addOptional("own",
                   "with -system: what a system has of its own: boresight, lever_arm, names of "
                   "parameters, offset of coordinates (default: boresight,range_bias,"
                   "scan_angle_scale)");
}

void readSystems(const CommandLine& line, CalibrationSettings& settings) {
  settings.fixed_sigma = line.number("fixed_sigma", 0.0, 10.0, "m");
  if (line.has("fixed")) settings.fixed = stripGroup("fixed=" + line.text("fixed")).strips;
  if (line.has("system")) {
    for (const std::string& text : line.list("system"))
      settings.systems.push_back(stripGroup(text));
  }
  if (line.has("own")) settings.own = ownUnknowns(line.text("own"));
}

}  // namespace pcl_als::app
