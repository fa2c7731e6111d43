// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iostream>
#include <set>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/survey_io.h>

#include "command_line.h"
#include "point_file_correction.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::grouped;
using app::Step;

CommandLine commandLine() {
  CommandLine line("pcl_als_apply",
                   "takes known system biases out of a point file (Habib et al. 2011, Eq. 13), or "
                   "puts them in.",
                   "IN OUT -trajectory T -calibration calibration.json [options]",
                   "pcl_als_apply strip1.las corrected1.las -trajectory trajectory.csv "
                   "-calibration calibration.json");
  line.addOptional("trajectory", "trajectory: .csv, or SBET .out/.sbet (needed)");
  line.addOptional("calibration", "calibration.json with the biases");
  line.addOptional("biases",
                   "NAME=VALUE,... instead of a calibration: assumed - true, in m, arcsec or 1; "
                   "names as in calibration.json");
  line.addFlag("invert", "put the biases in instead of taking them out");
  line.addOptional("crs",
                   "CRS of the points for an SBET, e.g. EPSG:32611 (default: the point file's)");
  line.addOptional("gps_week", "GPS week of times that are seconds of the week (default: found)");
  line.addOptional("line_fit",
                   "half width of the trajectory window in seconds (default: the calibration's, "
                   "else 0.5)");
  line.addFlag("keep_uncovered",
               "leave points without a trajectory as they are (default: refuse the file)");
  return line;
}

double numberIn(const std::string& text, const std::string& what) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(value)) {
    throw UsageError(what + ": '" + text + "' is not a finite number");
  }
  return value;
}

SystemVector parseBiases(const std::string& list) {
  SystemVector biases = SystemVector::Zero();
  std::set<SystemParameter> given;
  for (const std::string& part : app::splitList(list)) {
    const std::size_t equals = part.find('=');
    const auto parameter = systemParameterNamed(part.substr(0, equals));
    if (equals == std::string::npos || !parameter) {
      std::string names;
      for (const SystemParameterInfo& info : systemParameters()) {
        names.append(" ").append(info.name);
      }
      throw UsageError("option -biases: '" + part + "' is not NAME=VALUE with NAME one of" + names);
    }
    if (!given.insert(*parameter).second) {
      throw UsageError("option -biases: " + part.substr(0, equals) + " is given twice");
    }
    const double value = numberIn(part.substr(equals + 1), "option -biases");
    biases[indexOf(*parameter)] = value * infoOf(*parameter).internal_per_unit;
  }
  if (given.empty()) throw UsageError("option -biases: names no parameter");
  return biases;
}

/// Biases and the trajectory window they belong to; 0 where the file does not say.
CalibrationResult biasesOf(const CommandLine& line) {
  if (line.has("calibration") == line.has("biases")) {
    throw UsageError("give one of -calibration and -biases (see pcl_als_apply -h)");
  }
  if (line.has("calibration")) return readCalibration(line.text("calibration"));
  CalibrationResult result;
  const SystemVector biases = parseBiases(line.text("biases"));
  for (int i = 0; i < kSystemParameterCount; ++i) result.parameters[i].bias = biases[i];
  result.converged = true;
  return result;
}

Trajectory::Options trajectoryOptions(const CommandLine& line, const CalibrationResult& result) {
  Trajectory::Options options;
  if (result.line_fit_half_width > 0.0) options.line_fit_half_width = result.line_fit_half_width;
  if (line.has("line_fit")) {
    options.line_fit_half_width = numberIn(line.text("line_fit"), "option -line_fit");
    if (options.line_fit_half_width <= 0.0) {
      throw UsageError("option -line_fit: must be more than 0 seconds");
    }
  }
  return options;
}

/// The CRS an SBET is projected to; of the points where it is not given.
std::string crsOf(const CommandLine& line, const std::string& points) {
  return line.has("crs") ? line.text("crs") : PointReader::open(points)->info().crs;
}

void remark(const CommandLine& line, const std::string& text) {
  if (!text.empty() && !line.quiet()) std::cout << "  " << text << std::endl;
}

std::shared_ptr<const Trajectory> readFlight(const CommandLine& line, const std::string& points,
                                             const CalibrationResult& result) {
  const std::string path = line.text("trajectory");
  Step step("Reading " + path, line.quiet());
  auto trajectory = std::make_shared<const Trajectory>(readTrajectory(path, crsOf(line, points)),
                                                       trajectoryOptions(line, result));
  step.done(grouped(trajectory->size()) + " samples, " + std::to_string(trajectory->gaps().size()) +
            " gaps");
  for (const std::string& repair : trajectory->repairs()) remark(line, repair);
  return trajectory;
}

std::optional<int> gpsWeek(const CommandLine& line) {
  if (!line.has("gps_week")) return std::nullopt;
  const double week = numberIn(line.text("gps_week"), "option -gps_week");
  if (week < 0.0 || week > 9999.0 || week != std::floor(week)) {
    throw UsageError("option -gps_week: must be a whole number from 0 to 9999");
  }
  return static_cast<int>(week);
}

std::string biasText(const SystemVector& biases) {
  std::ostringstream text;
  for (const SystemParameterInfo& info : systemParameters()) {
    const double value = biases[indexOf(info.parameter)] / info.internal_per_unit;
    if (value == 0.0) continue;
    text << (text.tellp() > 0 ? ", " : "") << info.name << ' ' << value;
    if (info.unit != "1") text << ' ' << info.unit;
  }
  return text.tellp() > 0 ? text.str() : "all biases are zero";
}

int apply(int argc, char** argv) {
  CommandLine line = commandLine();
  if (!line.parse(argc, argv)) return app::kDone;
  const std::vector<std::string>& files = line.inputs(2, 2);
  if (!line.has("trajectory")) throw UsageError("option -trajectory is needed");
  const CalibrationResult calibration = biasesOf(line);
  app::PointFileCorrection correction;
  correction.gps_week = gpsWeek(line);
  correction.biases = calibration.biases();
  correction.invert = line.has("invert");
  correction.keep_uncovered = line.has("keep_uncovered");
  correction.threads = line.threads();
  if (!calibration.converged) remark(line, "the calibration did not converge");
  correction.trajectory = readFlight(line, files[0], calibration);
  remark(line, (correction.invert ? "putting in: " : "taking out: ") + biasText(correction.biases));

  Step step("Writing " + files[1], line.quiet());
  const app::PointFileCorrectionResult result = app::correctPointFile(
      files[0], files[1], correction, [&step](double fraction) { step.progress(fraction); });
  step.done(grouped(result.points) + " points");
  remark(line, result.time_remark);
  if (result.coverage.missed() > 0) {
    remark(line, "left as they are: " + result.coverage.describe(*correction.trajectory));
  }
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run("pcl_als_apply", [argc, argv] { return apply(argc, argv); });
}
