// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "flight_options.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/prior_file.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/io/trajectory_writer.h>
#include <pcl_als/processing/trajectory_from_points.h>

namespace pcl_als::app {
namespace {

constexpr double kLongestWindow = 60.0;  // seconds, half of it

/// -line_fit; \a otherwise where it is not given.
double halfWidthOf(const CommandLine& line, double otherwise) {
  return line.has("line_fit") ? line.number("line_fit") : otherwise;
}

/// What the word of a choice means; unchanged without the option.
template <typename T>
void choose(const CommandLine& line, const std::string& option, T& value,
            const std::vector<T>& meanings) {
  if (line.has(option)) value = meanings.at(line.choice(option));
}

/// The files of -trajectory, also those in a folder.
std::vector<std::filesystem::path> trajectoryInputs(const CommandLine& line) {
  std::vector<std::filesystem::path> files;
  for (const std::string& value : line.list("trajectory")) {
    std::error_code error;
    if (!std::filesystem::is_directory(value, error)) {
      files.emplace_back(value);
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(value, error))
      if (isTrajectoryFile(entry.path())) files.push_back(entry.path());
  }
  return files;
}

}  // namespace

void addFlightOptions(CommandLine& line, const std::string& use) {
  const OptionGroup group(line, Group::inputs);
  addTrajectoryOptions(line, use);
  line.addWhole("gps_week",
                "GPS week of times that are seconds of the week, in place of the one determined "
                "from the data",
                {}, {0, 9999, {}});
  // The flight is taken as straight within it.
  line.addNumber("line_fit",
                 "half width of the trajectory window, in place of the calibration's, else 0.5", {},
                 {0.001, kLongestWindow, "s"});
}

void addTrajectoryOptions(CommandLine& line, const std::string& use) {
  const OptionGroup group(line, Group::inputs);
  const std::string help =
      "trajectory: text (.csv, .txt, .pos, ...), SBET (.out, .sbet), TerraScan (.trj), RIEGL "
      "(.pof) or Leica (.sol); several files or a folder are joined in order of time; "
      "\"reconstruct\": from the points" +
      (use.empty() ? "" : " (" + use + ")");
  line.addInputFiles("trajectory", help, trajectoryInputs).is_needed = use.empty();
  line.addText("crs",
               "CRS of the points, e.g. EPSG:32611, for an SBET or other geographic "
               "coordinates (default: the point file's)");
  line.addText("trajectory_crs",
               "CRS of the trajectory's coordinates (default: WGS 84 for geographic and "
               "geocentric ones, that of the points for map coordinates)");
  addUnitsOption(line, "trajectory", "a trajectory of map coordinates");
  line.addText("columns",
               "columns of a trajectory text file in their order, e.g. "
               "time,easting,northing,height,roll,pitch,heading; skip: a column that is not "
               "used (default: by its header)");
  line.addChoice("trajectory_angles", "unit of trajectory angles that state none (default: deg)",
                 {"deg", "rad", "gon"});
  line.addChoice(
      "trajectory_axes",
      "ned: roll right wing down, pitch nose up, heading clockwise from north; enu: "
      "pitch nose down, yaw counter-clockwise from east; of quaternions what they turn the "
      "body to (default: ned; of a yaw and of quaternions as the course shows)",
      {"ned", "enu"});
  line.addChoice("trajectory_north",
                 "north that headings count from (default: grid for map coordinates, else true)",
                 {"true", "grid"});
  line.addNumber("leap_seconds",
                 "the trajectory's times are UTC: seconds to be added (18 since 2017)", {},
                 {0.0, 60.0, "s"});
  line.addInputFile("geoid",
                    "geoid undulation that is subtracted from the trajectory's heights: metres, or "
                    "a grid file that PROJ reads");
}

std::optional<int> gpsWeek(const CommandLine& line) {
  if (!line.has("gps_week")) return std::nullopt;
  return static_cast<int>(line.whole("gps_week"));
}

void addForceOption(CommandLine& line, const std::string& reason) {
  line.addFlag("force", "continue with a warning where " + reason + "; results may be wrong");
}

void requireUsable(const CommandLine& line, const std::string& file,
                   const CalibrationVerdict& verdict, const CalibrationUse& use) {
  if (verdict.usable()) return;
  if (!line.has("force"))
    throw InputError(file + ": this calibration should not be " + use.passive + ", " +
                     verdict.text() + "; -force " + use.active + " it all the same");
  std::cerr << line.tool() << ": warning: " << file << ": " << verdict.text() << std::endl;
}

CalibrationResult usableCalibration(const CommandLine& line) {
  const std::string file = line.text("calibration");
  CalibrationResult calibration = readPriorFile(file).calibration();
  requireUsable(line, file, calibration.verdict, {"applied", "applies"});
  return calibration;
}

void addModelOption(CommandLine& line) {
  const OptionGroup group(line, Group::estimation);
  line.addChoice(
      "model",
      "rigorous: roll, pitch and heading of the trajectory; quasi_rigorous: its positions only, "
      "pitch and crab from the points (linear scanners); nominal: rigorous with a level sensor "
      "whose "
      "heading is the course (conical and multi-plane scanners without attitude); auto: rigorous "
      "where the trajectory has attitude",
      {"auto", std::string(modelName(AttitudeSource::none)),
       std::string(modelName(AttitudeSource::trajectory)),
       std::string(toString(AttitudeSource::nominal))},
      "auto");
}

AttitudeUse attitudeUse(const CommandLine& line) {
  AttitudeUse use = AttitudeUse::where_given;
  choose(
      line, "model", use,
      {AttitudeUse::where_given, AttitudeUse::ignore, AttitudeUse::needed, AttitudeUse::nominal});
  return use;
}

TrajectoryReading trajectoryReading(const CommandLine& line, const std::string& points_crs) {
  TrajectoryReading reading;
  if (line.has("crs")) requireProjectedCrs(line.text("crs"), "option -crs");
  reading.crs = line.has("crs") ? line.text("crs") : points_crs;
  if (line.has("trajectory_crs")) reading.own_crs = line.text("trajectory_crs");
  reading.unit = unitOption(line, "trajectory");
  if (line.has("columns")) reading.columns = splitList(line.text("columns"));
  choose(line, "trajectory_angles", reading.angles,
         {AngleUnit::degrees, AngleUnit::radians, AngleUnit::gon});
  choose(line, "trajectory_axes", reading.axes, {AttitudeAxes::ned, AttitudeAxes::enu});
  choose(line, "trajectory_north", reading.north,
         {NorthReference::true_north, NorthReference::grid_north});
  if (line.has("leap_seconds")) reading.leap_seconds = line.number("leap_seconds");
  if (line.has("geoid")) reading.geoid = line.text("geoid");
  return reading;
}

std::vector<std::filesystem::path> trajectoryFiles(const CommandLine& line) {
  const std::vector<std::string> names = line.list("trajectory");
  return {names.begin(), names.end()};
}

void checkFlightOptions(const CommandLine& line) {
  trajectoryReading(line, {});
}

void addAccuracyOption(CommandLine& line, const std::string& use) {
  line.addInputFile(
          "trajectory_accuracy",
          "accuracies of the trajectory over time, an Applanix smrmsg or RIEGL .poq file: " + use)
      .formerly("accuracy");
}

std::vector<TrajectoryAccuracy> accuracies(const CommandLine& line) {
  return line.has("trajectory_accuracy") ? readAccuracies(line.text("trajectory_accuracy"))
                                         : std::vector<TrajectoryAccuracy>();
}

std::shared_ptr<const Trajectory> loadTrajectory(const CommandLine& line,
                                                 const std::string& points_crs, double half_width,
                                                 AttitudeUse attitude,
                                                 const std::vector<std::string>& points,
                                                 LoadedTrajectory* whole) {
  TrajectoryLoadingOptions options;
  static_cast<TrajectoryReading&>(options) = trajectoryReading(line, points_crs);
  options.line_fit_half_width = halfWidthOf(line, half_width);
  options.attitude = attitude;
  const std::vector<std::filesystem::path> files = trajectoryFiles(line);
  if (files.size() == 1 && files.front() == "reconstruct") {
    LoadedTrajectory file =
        reconstructTrajectory(points, options, line.threads(), progressOf(line));
    if (whole != nullptr) *whole = file;
    return file.trajectory;
  }
  Step step("Reading " + (files.size() == 1 ? files.front().string()
                                            : counted(files.size(), "trajectory file")),
            line.quiet());
  const LoadedTrajectory file = pcl_als::loadTrajectory(files, options);
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
