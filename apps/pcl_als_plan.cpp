// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include <unistd.h>

#include <pcl_als/calibration/flight_plan.h>
#include <pcl_als/calibration/quasi_rigorous_calibration.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/plan_io.h>

#include "command_line.h"
#include "flight_options.h"
#include "plan_report.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;
namespace fs = std::filesystem;

void addErrorOptions(CommandLine& line) {
  const CalibrationSettings defaults;
  line.add("range_noise", "standard deviation of a range, m", defaults.noise.range);
  line.add("angle_noise", "standard deviation of pointing, arcsec",
           defaults.noise.angle / kRadiansPerArcsec);
  line.add("beam_divergence", "full angle at 1/e^2, mrad", 1e3 * defaults.noise.beam_divergence);
  line.add("position_sigma", "trajectory errors that a strip shares: position, m",
           defaults.shared_errors.position);
  line.add("roll_pitch_sigma", "the same: roll and pitch, arcsec",
           defaults.shared_errors.roll_pitch / kRadiansPerArcsec);
  line.add("heading_sigma", "the same: heading, arcsec",
           defaults.shared_errors.heading / kRadiansPerArcsec);
  line.add("control_sigma", "heights of control points, m", defaults.control_sigma);
}

CommandLine commandLine() {
  const SurfaceModel surface;
  CommandLine line("pcl_als_plan",
                   "says what a planned calibration flight will determine, how well, and which "
                   "line to add.",
                   "-lines plan.csv [options]",
                   "pcl_als_plan -lines plan.csv -control 5 -density 2 -output plan.json");
  line.addOptional("lines",
                   "lines: CSV id,x1,y1,x2,y2,height[,speed][,density], metres in any local frame, "
                   "height above mean ground (needed)");
  line.add("fov", "full field of view, degrees", 40.0);
  line.add("speed", "of lines whose file gives none, m/s", 60.0);
  line.addOptional("density", "pulses per m2, of lines whose file gives none (default: 1)");
  line.addOptional("spacing", "the same as distance between points, m");
  line.add("ground_slope", "RMS slope of open ground, degrees; 0: a plane",
           surface.ground_slope / kRadiansPerDegree);
  line.add("slope", "of steep surfaces (roofs, banks), degrees",
           surface.steep_slope / kRadiansPerDegree);
  line.add("sloped", "their share of the usable surface, 0 to 1", surface.steep_share);
  line.add("usable", "share of the points on solid, smooth surfaces, 0 to 1", surface.usable);
  line.addOptional("terrain",
                   "elevations in the frame of the lines: ESRI ASCII grid (.asc), in "
                   "place of -ground_slope");
  line.add("control", "vertical control points, spread over the block", 0);
  line.add<std::string>("estimate",
                        "parameters to estimate, e.g. boresight_roll,range_bias; auto: all that "
                        "the flight determines",
                        "auto");
  line.addOptional("output", "plan.json to write");
  addErrorOptions(line);
  return line;
}

double densityOf(const CommandLine& line) {
  if (line.has("density") && line.has("spacing")) {
    throw UsageError("options -density and -spacing: give one of them");
  }
  const char* option = line.has("spacing") ? "spacing" : "density";
  if (!line.has(option)) return 1.0;
  const std::string what = std::string("option -") + option;
  const double value = app::numberIn(line.text(option), what);
  const bool spacing = line.has("spacing");
  if (value < (spacing ? 0.05 : 0.01) || value > (spacing ? 10.0 : 400.0)) {
    throw UsageError(what + ": " + line.text(option) + " is outside " +
                     (spacing ? "[0.05, 10] m" : "[0.01, 400] per m2"));
  }
  return spacing ? 1.0 / (value * value) : value;
}

SurfaceModel surfaceOf(const CommandLine& line) {
  SurfaceModel surface;
  surface.ground_slope = line.number("ground_slope", 0.0, 45.0, "degrees") * kRadiansPerDegree;
  surface.steep_slope = line.number("slope", 0.0, 60.0, "degrees") * kRadiansPerDegree;
  surface.steep_share = line.number("sloped", 0.0, 1.0, "of the surface");
  surface.usable = line.number("usable", 0.001, 1.0, "of the points");
  if (!line.has("terrain")) return surface;
  Step step("Reading " + line.text("terrain"), line.quiet());
  const auto grid =
      std::make_shared<const ElevationGrid>(ElevationGrid::read(line.text("terrain")));
  step.done(std::to_string(grid->columns()) + " x " + std::to_string(grid->rows()) + " cells");
  surface.terrain = [grid](const Eigen::Vector2d& place) -> std::optional<SurfacePoint> {
    Eigen::Vector2d gradient;
    const std::optional<double> z = grid->at(place, gradient);
    if (!z) return std::nullopt;
    return SurfacePoint{*z - grid->mean(),
                        Eigen::Vector3d(-gradient.x(), -gradient.y(), 1.0).normalized()};
  };
  return surface;
}

std::vector<SystemParameter> parametersToEstimate(const std::string& list) {
  std::vector<SystemParameter> parameters;
  if (list == "auto") return parameters;
  for (const std::string& name : app::splitList(list)) {
    const SystemParameter parameter = app::parameterNamed(name, "option -estimate");
    if (std::find(parameters.begin(), parameters.end(), parameter) == parameters.end()) {
      parameters.push_back(parameter);
    }
  }
  if (parameters.empty()) throw UsageError("option -estimate: names no parameter");
  return parameters;
}

FlightPlan::Settings settingsOf(const CommandLine& line) {
  FlightPlan::Settings settings;
  ObservabilitySettings& adjustment = settings.adjustment;
  adjustment.estimate = parametersToEstimate(line.text("estimate"));
  NoiseModel& noise = adjustment.pairs.noise;
  noise.range = line.number("range_noise", 1e-4, 1.0, "m");
  noise.angle = line.number("angle_noise", 0.0, 1000.0, "arcsec") * kRadiansPerArcsec;
  noise.beam_divergence = 1e-3 * line.number("beam_divergence", 0.0, 10.0, "mrad");
  SharedErrorModel& shared = adjustment.shared_errors;
  shared.position = line.number("position_sigma", 1e-5, 10.0, "m");
  shared.roll_pitch = line.number("roll_pitch_sigma", 0.01, 10000.0, "arcsec") * kRadiansPerArcsec;
  shared.heading = line.number("heading_sigma", 0.01, 10000.0, "arcsec") * kRadiansPerArcsec;
  adjustment.pairs.control_sigma = line.number("control_sigma", 1e-4, 10.0, "m");
  adjustment.threads = line.threads();
  const int control = line.get<int>("control");
  if (control < 0 || control > 1000) {
    throw UsageError("option -control: " + std::to_string(control) + " is outside [0, 1000]");
  }
  settings.control_points = static_cast<std::size_t>(control);
  return settings;
}

std::vector<StripGeometry> plannedLines(const CommandLine& line) {
  StripGeometry common;
  common.half_angle = 0.5 * line.number("fov", 1.0, 120.0, "degrees") * kRadiansPerDegree;
  common.speed = line.number("speed", 1.0, 400.0, "m/s");
  common.density = densityOf(line);
  const std::string path = line.text("lines");
  Step step("Reading " + path, line.quiet());
  std::vector<StripGeometry> lines;
  for (const FlightLineRecord& record : readFlightLines(path)) {
    StripGeometry& planned = lines.emplace_back(common);
    planned.id = record.id;
    planned.start = record.start;
    planned.end = record.end;
    planned.height = record.height;
    planned.speed = record.speed.value_or(common.speed);
    planned.density = record.density.value_or(common.density);
    try {
      planned.validate();
    } catch (const UsageError& error) {  // the file's fault, not the command's
      throw InputError(path + ": " + error.what());
    }
  }
  step.done(std::to_string(lines.size()) + " lines");
  return lines;
}

/// What can be known to fail should fail before the work, not after it.
void checkOutput(const CommandLine& line) {
  if (!line.has("output")) return;
  const fs::path folder = fs::absolute(line.text("output")).parent_path();
  if (fs::is_directory(folder) && access(folder.c_str(), W_OK) == 0) return;
  throw InputError("cannot write " + line.text("output") + ": " + folder.string() +
                   " is no folder that can be written to");
}

std::string whyNot(const CalibrationResult& expected) {
  std::string why;
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = expected[info.parameter];
    if (estimate.status != ParameterStatus::not_estimable) continue;
    why += (why.empty() ? "" : "; ") + std::string(info.name) + " will not be determined (" +
           estimate.reason + ")";
  }
  return why;
}

int plan(int argc, char** argv) {
  CommandLine line = commandLine();
  if (!line.parse(argc, argv)) return app::kDone;
  line.inputs(0, 0);
  if (!line.has("lines")) throw UsageError("option -lines is needed");
  FlightPlan::Settings settings = settingsOf(line);
  checkOutput(line);
  std::vector<StripGeometry> lines = plannedLines(line);
  settings.adjustment.pairs.surface = surfaceOf(line);
  const FlightPlan flight(std::move(lines), settings);
  Step step("Adjusting the plan", line.quiet());
  const FlightPlanResult result = flight.evaluate();
  step.done(std::to_string(result.overlaps.size()) + " overlapping pairs, " +
            std::to_string(result.control_points) + " control points");
  if (line.has("output")) {
    std::vector<std::string> inputs{line.text("lines")};
    if (line.has("terrain")) inputs.push_back(line.text("terrain"));
    app::writePlan(line.text("output"), result, inputs);
  }
  if (!line.quiet()) std::cout << '\n' << app::planTables(result) << std::flush;
  if (result.expected.converged) return app::kDone;
  std::cerr << "pcl_als_plan: no reliable answer: " << whyNot(result.expected) << std::endl;
  return app::kNoReliableAnswer;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run("pcl_als_plan", [argc, argv] { return plan(argc, argv); });
}
