// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iostream>
#include <memory>

#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/plan_io.h>
#include <pcl_als/planning/flight_plan.h>
#include <pcl_als/report/plan_report.h>

#include "adjustment_options.h"
#include "command_line.h"
#include "flight_options.h"
#include "output_check.h"
#include "remedy_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;

CommandLine commandLine() {
  const SurfaceModel surface;
  CommandLine line("pcl_als_plan",
                   "predicts the standard deviations of the parameters from a planned calibration "
                   "flight, and which line to add.",
                   "-lines plan.csv [options]",
                   "pcl_als_plan -lines plan.csv -control 5 -density 2 -output plan.json");
  line.addOptional("lines",
                   "lines: CSV id,x1,y1,x2,y2,height[,speed][,density], metres in any local frame, "
                   "height above mean ground (needed)");
  line.add("fov", "full field of view, degrees", 40.0);
  line.add("speed", "speed of lines whose file gives none, m/s", 60.0);
  line.addOptional("density", "pulses per m2, of lines whose file gives none (default: 1)");
  line.addOptional("spacing", "point spacing instead of -density, m");
  line.add("ground_slope", "RMS slope of open ground, degrees; 0: a plane",
           surface.ground_slope / kRadiansPerDegree);
  line.add("slope", "slope of steep surfaces (roofs, banks), degrees",
           surface.steep_slope / kRadiansPerDegree);
  line.add("sloped", "share of steep surfaces in the usable surface, 0 to 1", surface.steep_share);
  line.add("usable", "share of the points on solid, smooth surfaces, 0 to 1", surface.usable);
  line.addOptional("terrain",
                   "elevations in the frame of the lines: ESRI ASCII grid (.asc), in "
                   "place of -ground_slope");
  line.add("control", "number of vertical control points, distributed over the block", 0);
  app::addEstimateOption(line, "the flight determines");
  line.addOptional("output", "plan.json to write");
  app::addErrorOptions(line);
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

FlightPlan::Settings settingsOf(const CommandLine& line) {
  FlightPlan::Settings settings;
  ObservabilitySettings& adjustment = settings.adjustment;
  adjustment.estimate = app::parametersToEstimate(line);
  adjustment.pairs.noise = app::noiseOf(line);
  adjustment.shared_errors = app::sharedErrorsOf(line);
  adjustment.pairs.control_sigma = app::controlSigmaOf(line);
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

int plan(int argc, char** argv) {
  CommandLine line = commandLine();
  if (!line.parse(argc, argv)) return app::kDone;
  line.inputs(0, 0);
  if (!line.has("lines")) throw UsageError("option -lines is needed");
  FlightPlan::Settings settings = settingsOf(line);
  if (line.has("output")) app::checkWritable(line.text("output"));
  std::vector<StripGeometry> lines = plannedLines(line);
  settings.adjustment.pairs.surface = surfaceOf(line);
  const FlightPlan flight(std::move(lines), settings);
  Step step("Adjusting the plan", line.quiet());
  FlightPlanResult result = flight.evaluate();
  app::nameOptions(line, result.expected.warnings);
  step.done(std::to_string(result.overlaps.size()) + " overlapping pairs, " +
            std::to_string(result.control_points) + " control points");
  if (line.has("output")) {
    std::vector<std::string> inputs{line.text("lines")};
    if (line.has("terrain")) inputs.push_back(line.text("terrain"));
    writePlan(line.text("output"), result, inputs);
  }
  if (!line.quiet()) std::cout << '\n' << planTables(result) << std::flush;
  if (result.expected.converged) return app::kDone;
  std::cerr << "pcl_als_plan: no reliable answer: "
            << app::notDetermined(result.expected, "will not be") << std::endl;
  return app::kNoReliableAnswer;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run("pcl_als_plan", [argc, argv] { return plan(argc, argv); });
}
