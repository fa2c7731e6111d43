// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "adjustment_options.h"

#include <algorithm>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/errors.h>

#include "flight_options.h"

namespace pcl_als::app {

void addErrorOptions(CommandLine& line) {
  const OptionGroup group(line, Group::priors);
  const CalibrationSettings defaults;
  line.addNumber("range_noise", "standard deviation of ranges", defaults.noise.range,
                 {1e-4, 1.0, "m"});
  line.addNumber("angle_noise", "standard deviation of pointing",
                 defaults.noise.angle / kRadiansPerArcsec, {0.0, 1000.0, "arcsec"});
  line.addNumber("beam_divergence", "full divergence of the beam at 1/e^2",
                 1e3 * defaults.noise.beam_divergence, {0.0, 10.0, "mrad"});
  line.addText("ins",
               "grade of the GNSS/INS, whose data sheet gives the three standard deviations "
               "that follow: survey, tactical or mems (0.04 m, 90\", 288\")");
  line.addNumber("position_sigma", "prior standard deviation of trajectory errors: position",
                 defaults.shared_errors.position, {1e-5, 10.0, "m"});
  line.addNumber("roll_pitch_sigma",
                 "prior standard deviation of trajectory errors: roll and pitch",
                 defaults.shared_errors.roll_pitch / kRadiansPerArcsec, {0.01, 10000.0, "arcsec"});
  line.addNumber("heading_sigma", "prior standard deviation of trajectory errors: heading",
                 defaults.shared_errors.heading / kRadiansPerArcsec, {0.01, 10000.0, "arcsec"});
  line.addNumber("control_sigma", "standard deviation of control points whose file gives none",
                 defaults.control_sigma, {1e-4, 10.0, "m"});
}

NoiseModel noiseOf(const CommandLine& line) {
  NoiseModel noise;
  noise.range = line.number("range_noise");
  noise.angle = line.number("angle_noise") * kRadiansPerArcsec;
  noise.beam_divergence = 1e-3 * line.number("beam_divergence");
  return noise;
}

SharedErrorModel sharedErrorsOf(const CommandLine& line) {
  SharedErrorModel shared;
  if (line.has("ins")) shared = line.parsed("ins", SharedErrorModel::ofGrade);
  const auto set = [&line](const char* name, double unit, double& value) {
    if (!line.has("ins") || line.given(name)) value = line.number(name) * unit;
  };
  set("position_sigma", 1.0, shared.position);
  set("roll_pitch_sigma", kRadiansPerArcsec, shared.roll_pitch);
  set("heading_sigma", kRadiansPerArcsec, shared.heading);
  return shared;
}

void addEstimateOption(CommandLine& line, const std::string& subject) {
  const std::string help =
      "parameters to estimate, e.g. boresight_roll,range_bias; auto: all that " + subject;
  line.addText("estimate", help, "auto").in(Group::estimation);
}

std::vector<SystemParameter> parametersToEstimate(const CommandLine& line) {
  if (line.text("estimate") == "auto") return {};
  return line.parsed("estimate", systemParametersIn);
}

void addSystemOptions(CommandLine& line) {
  const OptionGroup group(line, Group::estimation);
  line.addTexts("systems",
                "NAME=STRIPS[:CHANNEL] ...: systems with biases of their own, e.g. north=1-4 "
                "south=5-9, or a=1-9:0 b=1-9:1 with -channels; strips that none names are of the "
                "first one")
      .formerly("system");
  line.addText("fixed",
               "strips that are held fixed, e.g. 1,4-6: an earlier delivery, already corrected, "
               "that the block joins; they are not corrected");
  line.addNumber("fixed_sigma",
                 "standard deviation of an error that all fixed strips share, each axis",
                 CalibrationSettings().fixed_sigma, {0.0, 10.0, "m"});
  line.addText("own",
               "with -systems: what a system has of its own: boresight, lever_arm, names of "
               "parameters, offset of coordinates (default: boresight,range_bias,"
               "scan_angle_scale)");
  line.makeDependent("own", "systems");
  line.makeDependent("fixed_sigma", "fixed");
}

void readSystems(const CommandLine& line, CalibrationSettings& settings) {
  settings.fixed_sigma = line.number("fixed_sigma");
  if (line.has("fixed")) settings.fixed = stripGroup("fixed=" + line.text("fixed")).strips;
  if (line.has("systems")) {
    for (const std::string& text : line.list("systems"))
      settings.systems.push_back(stripGroup(text));
  }
  if (line.has("own")) settings.own = ownUnknowns(line.text("own"));
}

}  // namespace pcl_als::app
