// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iostream>
#include <memory>

#include <pcl_als/calibration/flight_plan.h>
#include <pcl_als/common/atomic_file.h>
#include <pcl_als/io/plan_io.h>
#include <pcl_als/processing/planned_strips.h>
#include <pcl_als/report/plan_report.h>

#include "adjustment_options.h"
#include "command_line.h"
#include "flight_options.h"
#include "hint_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;

constexpr double kComplete = 0.995;  // of the lines: less is worth a remark

void addPlannedFlight(CommandLine& line) {
  const app::OptionGroup group(line, app::Group::inputs);
  const SurfaceModel surface;
  line.addInputFile("lines",
                    "lines: CSV id,x1,y1,x2,y2,height[,speed][,density], metres in any local "
                    "frame, height above mean ground")
      .needed();
  line.addNumber("fov", "full field of view", 40.0, {1.0, 120.0, "degrees"});
  line.addNumber("speed", "speed of lines whose file gives none", 60.0, {1.0, 400.0, "m/s"});
  line.addNumber("pulse_density", "pulses of lines whose file gives none (default: 1)", {},
                 {0.01, 400.0, "per m2"})
      .formerly("density");
  line.addNumber("spacing", "point spacing instead of -pulse_density", {}, {0.05, 10.0, "m"});
  line.exclude({"pulse_density", "spacing"});
  line.addNumber("ground_slope", "RMS slope of open ground; 0: a plane",
                 surface.ground_slope / kRadiansPerDegree, {0.0, 45.0, "degrees"});
  line.addNumber("slope", "slope of steep surfaces (roofs, banks)",
                 surface.steep_slope / kRadiansPerDegree, {0.0, 60.0, "degrees"});
  line.addNumber("sloped", "share of steep surfaces in the usable surface", surface.steep_share,
                 {0.0, 1.0});
  line.addNumber("usable", "share of the points on solid, smooth surfaces", surface.usable,
                 {0.001, 1.0});
  line.addInputFile("terrain",
                    "elevations in the frame of the lines: ESRI ASCII grid (.asc), in "
                    "place of -ground_slope");
  line.exclude({"terrain", "ground_slope"});
  line.addWhole("control", "number of vertical control points, distributed over the block", 0,
                {0, 1000, {}});
}

CommandLine commandLine() {
  CommandLine line("pcl_als_plan",
                   "predicts the standard deviations of the parameters from a planned calibration "
                   "flight, and which line to add.",
                   "-lines plan.csv [options]",
                   "pcl_als_plan -lines plan.csv -control 5 -pulse_density 2 -output plan.json");
  addPlannedFlight(line);
  app::addEstimateOption(line, "the flight determines");
  line.addOutputFile("output", "plan.json to write", {".json"});
  app::addErrorOptions(line);
  return line;
}

double densityOf(const CommandLine& line) {
  if (line.has("spacing")) return std::pow(line.number("spacing"), -2.0);
  return line.has("pulse_density") ? line.number("pulse_density") : 1.0;
}

SurfaceModel surfaceOf(const CommandLine& line, const std::vector<StripGeometry>& lines) {
  SurfaceModel surface;
  surface.ground_slope = line.number("ground_slope") * kRadiansPerDegree;
  surface.steep_slope = line.number("slope") * kRadiansPerDegree;
  surface.steep_share = line.number("sloped");
  surface.usable = line.number("usable");
  if (!line.has("terrain")) return surface;
  Step step("Reading " + line.text("terrain"), line.quiet());
  const auto grid =
      std::make_shared<const ElevationGrid>(ElevationGrid::read(line.text("terrain")));
  step.done(std::to_string(grid->columns()) + " x " + std::to_string(grid->rows()) + " cells");
  const double covered = terrainCoverage(lines, *grid, line.text("terrain"));
  if (covered < kComplete) {
    app::remark(line, "the terrain covers " + std::to_string(std::lround(100.0 * covered)) +
                          " % of the swaths; elsewhere the ground is taken as level");
  }
  surface.terrain = terrainOf(grid);
  return surface;
}

FlightPlan::Settings settingsOf(const CommandLine& line) {
  FlightPlan::Settings settings;
  settings.estimate = app::parametersToEstimate(line);
  settings.noise = app::noiseOf(line);
  settings.shared_errors = app::sharedErrorsOf(line);
  settings.control_sigma = line.number("control_sigma");
  settings.threads = line.threads();
  settings.control_points = line.whole("control");
  return settings;
}

std::vector<StripGeometry> plannedLines(const CommandLine& line) {
  StripGeometry common;
  common.half_angle = 0.5 * line.number("fov") * kRadiansPerDegree;
  common.speed = line.number("speed");
  common.density = densityOf(line);
  const std::string path = line.text("lines");
  Step step("Reading " + path, line.quiet());
  std::vector<StripGeometry> lines = readPlannedStrips(path, common);
  step.done(std::to_string(lines.size()) + " lines");
  return lines;
}

int plan(const CommandLine& line) {
  FlightPlan::Settings settings = settingsOf(line);
  std::vector<StripGeometry> lines = plannedLines(line);
  settings.surface = surfaceOf(line, lines);
  const FlightPlan flight(std::move(lines), settings);
  Step step("Adjusting the plan", line.quiet());
  FlightPlanResult result = flight.evaluate();
  app::nameOptions(line, result.expected.warnings);
  step.done(std::to_string(result.overlaps.size()) + " overlapping pairs, " +
            std::to_string(result.control_points) + " control points");
  if (line.has("output")) {
    std::vector<std::string> inputs{line.text("lines")};
    if (line.has("terrain")) inputs.push_back(line.text("terrain"));
    writeFile(line.text("output"), planJson(result, inputs));
  }
  if (!line.quiet()) std::cout << '\n' << planTables(result) << std::flush;
  return app::conclude(line, result.expected.converged ? "" : notDetermined(result.expected));
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, plan);
}
