// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "flight_options.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/survey_io.h>

namespace pcl_als::app {
namespace {

constexpr double kLongestWindow = 60.0;  // seconds, half of it

}  // namespace

void addFlightOptions(CommandLine& line, const char* use) {
  const std::string help = std::string("trajectory: .csv, or SBET .out/.sbet (") + use + ")";
  line.addOptional("trajectory", help.c_str());
  line.addOptional("crs",
                   "CRS of the points for an SBET, e.g. EPSG:32611 (default: the point file's)");
  addUnitsOption(line, "trajectory", "a trajectory CSV");
  line.addOptional(
      "gps_week",
      "GPS week of times that are seconds of the week (default: determined from the data)");
  line.addOptional(
      "line_fit",
      "half width of the trajectory window, seconds (default: the calibration's, else 0.5)");
}

SystemParameter parameterNamed(const std::string& name, const std::string& what) {
  if (const auto parameter = systemParameterNamed(name)) return *parameter;
  std::string names;
  for (const SystemParameterInfo& info : systemParameters()) names.append(" ").append(info.name);
  throw UsageError(what + ": '" + name + "' is none of" + names);
}

std::optional<int> gpsWeek(const CommandLine& line) {
  if (!line.has("gps_week")) return std::nullopt;
  const double week = numberIn(line.text("gps_week"), "option -gps_week", 0.0, 9999.0);
  if (week != std::floor(week)) {
    throw UsageError("option -gps_week: must be a whole number from 0 to 9999");
  }
  return static_cast<int>(week);
}

void addForceOption(CommandLine& line, const std::string& reason) {
  const std::string help = "continue with a warning where " + reason + "; results may be wrong";
  line.addFlag("force", help.c_str());
}

void addModelOption(CommandLine& line) {
  line.add<std::string>(
      "model",
      "rigorous: roll, pitch and heading of the trajectory; quasi_rigorous: its positions only, "
      "pitch and crab from the points (linear scanners); nominal: rigorous with a level sensor "
      "whose "
      "heading is the course (conical and multi-plane scanners without attitude); auto: rigorous "
      "where the trajectory has attitude",
      "auto");
}

AttitudeUse attitudeUse(const CommandLine& line) {
  const std::string model = line.text("model");
  if (model == "auto") return AttitudeUse::where_given;
  if (model == modelName(AttitudeSource::trajectory)) return AttitudeUse::needed;
  if (model == modelName(AttitudeSource::none)) return AttitudeUse::ignore;
  if (model == toString(AttitudeSource::nominal)) return AttitudeUse::nominal;
  throw UsageError("option -model: '" + model +
                   "' is not auto, quasi_rigorous, rigorous or nominal");
}

namespace {

/// -line_fit; \a otherwise where it is not given.
double halfWidthOf(const CommandLine& line, double otherwise) {
  if (!line.has("line_fit")) return otherwise;
  // The flight is taken as straight within it.
  return numberIn(line.text("line_fit"), "option -line_fit, seconds", 0.001, kLongestWindow);
}

}  // namespace

std::shared_ptr<const Trajectory> readFlight(const CommandLine& line, const std::string& points_crs,
                                             double half_width, AttitudeUse attitude) {
  if (!line.has("trajectory")) throw UsageError("option -trajectory is needed");
  FlightFileOptions options;
  options.line_fit_half_width = halfWidthOf(line, half_width);
  options.attitude = attitude;
  if (line.has("crs")) requireProjectedCrs(line.text("crs"), "option -crs");
  options.crs = line.has("crs") ? line.text("crs") : points_crs;
  options.unit = unitOption(line, "trajectory");
  Step step("Reading " + line.text("trajectory"), line.quiet());
  const FlightFile file = pcl_als::readFlight(line.text("trajectory"), options);
  const Trajectory& flight = *file.trajectory;
  step.done(grouped(flight.size()) + " samples, " + counted(flight.gaps().size(), "gap") +
            (flight.attitudeIsNominal() ? ", nominal attitude"
             : flight.hasAttitude()     ? ", with attitude"
                                        : ""));
  remarks(line, file.remarks);
  return file.trajectory;
}

}  // namespace pcl_als::app
