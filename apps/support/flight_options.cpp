// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "flight_options.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/trajectory_writer.h>
#include <pcl_als/processing/flight_reconstruction.h>

namespace pcl_als::app {
namespace {

constexpr double kLongestWindow = 60.0;  // seconds, half of it

/// -line_fit; \a otherwise where it is not given.
double halfWidthOf(const CommandLine& line, double otherwise) {
  if (!line.has("line_fit")) return otherwise;
  // The flight is taken as straight within it.
  return numberIn(line.text("line_fit"), "option -line_fit, seconds", 0.001, kLongestWindow);
}

/// The value of a word that an option gives; unchanged without the option.
template <typename T>
void choose(const CommandLine& line, const char* option, T& value,
            const std::vector<std::pair<std::string, T>>& words) {
  if (!line.has(option)) return;
  std::vector<std::string> names;
  for (const auto& [word, meaning] : words) names.push_back(word);
  value = words[line.choice(option, names)].second;
}

}  // namespace

void addFlightOptions(CommandLine& line, const char* use) {
  addTrajectoryOptions(line, use);
  line.addOptional(
      "gps_week",
      "GPS week of times that are seconds of the week (default: determined from the data)");
  line.addOptional(
      "line_fit",
      "half width of the trajectory window, seconds (default: the calibration's, else 0.5)");
}

void addTrajectoryOptions(CommandLine& line, const char* use) {
  const std::string help =
      std::string(
          "trajectory: text (.csv, .txt, .pos, ...), SBET (.out, .sbet), TerraScan (.trj), RIEGL "
          "(.pof) or Leica (.sol); several files or a folder are joined in order of time; "
          "\"reconstruct\": from the points (") +
      use + ")";
  line.addList("trajectory", help.c_str());
  line.addOptional("crs",
                   "CRS of the points, e.g. EPSG:32611, for an SBET or other geographic "
                   "coordinates (default: the point file's)");
  line.addOptional("trajectory_crs",
                   "CRS of the trajectory's coordinates (default: WGS 84 for geographic and "
                   "geocentric ones, that of the points for map coordinates)");
  addUnitsOption(line, "trajectory", "a trajectory of map coordinates");
  line.addOptional("columns",
                   "columns of a trajectory text file in their order, e.g. "
                   "time,easting,northing,height,roll,pitch,heading; skip: a column that is not "
                   "used (default: by its header)");
  line.addOptional("trajectory_angles",
                   "unit of trajectory angles that state none: deg, rad or gon (default: deg)");
  line.addOptional("trajectory_axes",
                   "ned: roll right wing down, pitch nose up, heading clockwise from north; enu: "
                   "pitch nose down, yaw counter-clockwise from east (default: ned)");
  line.addOptional("trajectory_north",
                   "north that headings count from: true or grid (default: grid for map "
                   "coordinates, else true)");
  line.addOptional("leap_seconds",
                   "the trajectory's times are UTC: seconds to be added (18 since 2017)");
  line.addOptional("geoid",
                   "geoid undulation that is subtracted from the trajectory's heights: metres, or "
                   "a grid file that PROJ reads");
}

std::optional<int> gpsWeek(const CommandLine& line) {
  if (!line.has("gps_week")) return std::nullopt;
  const std::uint64_t week = line.wholeNumber("gps_week");
  if (week > 9999) throw UsageError("option -gps_week: must be 0 to 9999");
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
  AttitudeUse use = AttitudeUse::where_given;
  choose(line, "model", use,
         {{"auto", AttitudeUse::where_given},
          {std::string(modelName(AttitudeSource::none)), AttitudeUse::ignore},
          {std::string(modelName(AttitudeSource::trajectory)), AttitudeUse::needed},
          {std::string(toString(AttitudeSource::nominal)), AttitudeUse::nominal}});
  return use;
}

TrajectoryReading trajectoryReading(const CommandLine& line, const std::string& points_crs) {
  TrajectoryReading reading;
  if (line.has("crs")) requireProjectedCrs(line.text("crs"), "option -crs");
  reading.crs = line.has("crs") ? line.text("crs") : points_crs;
  if (line.has("trajectory_crs")) reading.own_crs = line.text("trajectory_crs");
  reading.unit = unitOption(line, "trajectory");
  if (line.has("columns")) reading.columns = splitList(line.text("columns"));
  using Angles = AngleUnit;
  choose(line, "trajectory_angles", reading.angles,
         {{"deg", Angles::degrees}, {"rad", Angles::radians}, {"gon", Angles::gon}});
  choose(line, "trajectory_axes", reading.axes,
         {{"ned", AttitudeAxes::ned}, {"enu", AttitudeAxes::enu}});
  choose(line, "trajectory_north", reading.north,
         {{"true", NorthReference::true_north}, {"grid", NorthReference::grid_north}});
  if (line.has("leap_seconds"))
    reading.leap_seconds = numberIn(line.text("leap_seconds"), "option -leap_seconds", 0.0, 60.0);
  if (line.has("geoid")) reading.geoid = line.text("geoid");
  return reading;
}

std::vector<std::filesystem::path> trajectoryFiles(const CommandLine& line) {
  if (!line.has("trajectory")) throw UsageError("option -trajectory is needed");
  const std::vector<std::string> names = line.list("trajectory");
  return {names.begin(), names.end()};
}

void checkFlightOptions(const CommandLine& line) {
  gpsWeek(line);
  halfWidthOf(line, 0.0);
  trajectoryReading(line, {});
}

void addAccuracyOption(CommandLine& line, const char* use) {
  const std::string help =
      std::string(
          "accuracies of the trajectory over time, an Applanix smrmsg or RIEGL .poq file: ") +
      use;
  line.addOptional("accuracy", help.c_str());
}

std::vector<TrajectoryAccuracy> accuracies(const CommandLine& line) {
  return line.has("accuracy") ? readAccuracies(line.text("accuracy"))
                              : std::vector<TrajectoryAccuracy>();
}

std::shared_ptr<const Trajectory> readFlight(const CommandLine& line, const std::string& points_crs,
                                             double half_width, AttitudeUse attitude,
                                             const std::vector<std::string>& points,
                                             FlightFile* whole) {
  FlightFileOptions options;
  static_cast<TrajectoryReading&>(options) = trajectoryReading(line, points_crs);
  options.line_fit_half_width = halfWidthOf(line, half_width);
  options.attitude = attitude;
  const std::vector<std::filesystem::path> files = trajectoryFiles(line);
  if (files.size() == 1 && files.front() == "reconstruct") {
    FlightFile file = reconstructFlight(points, options, line.threads(), progressOf(line));
    if (whole != nullptr) *whole = file;
    return file.trajectory;
  }
  Step step("Reading " + (files.size() == 1 ? files.front().string()
                                            : counted(files.size(), "trajectory file")),
            line.quiet());
  const FlightFile file = pcl_als::readFlight(files, options);
  if (whole != nullptr) *whole = file;
  const Trajectory& flight = *file.trajectory;
  step.done(grouped(flight.size()) + " samples, " + counted(flight.gaps().size(), "gap") +
            (flight.attitudeIsNominal() ? ", nominal attitude"
             : flight.hasAttitude()     ? ", with attitude"
                                        : ""));
  if (file.format != "text") remark(line, file.format + ": " + file.frame);
  remarks(line, file.remarks);
  return file.trajectory;
}

}  // namespace pcl_als::app
