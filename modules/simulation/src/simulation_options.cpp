// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/simulation/simulation_options.h>

namespace pcl_als::simulation {

namespace {

void require(double value, double low, double high, const std::string& what) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  std::ostringstream text;
  text << "simulation: " << what << ' ' << value << " is outside [" << low << ", " << high << ']';
  throw UsageError(text.str());
}

void checkLine(const PlannedLine& line) {
  const std::string name = "line " + std::to_string(line.id) + ": ";
  require((line.end - line.start).norm(), 1.0, 200000.0, name + "length (m)");
  require(line.height, 20.0, 8000.0, name + "height (m)");
  require(line.speed, 1.0, 300.0, name + "speed (m/s)");
  require(line.density, 1e-4, 1000.0, name + "density (pulses/m2)");
  require(line.gain, 0.01, 100.0, name + "gain");
}

/// A scanner without a mirror has no error of its encoder, and so on.
void checkErrors(const SimulationOptions& options) {
  const ScannerOptions& scanner = options.scanner;
  const std::string name(nameOf(scanner.type));
  const auto refuse = [&](ErrorSource source, const char* what) {
    if (options.errors.any(source)) throw UsageError("simulation: a scanner " + name + what);
  };
  if (scanner.type != ScannerType::oscillating)
    refuse(ErrorSource::mirror_torsion, " has no mirror that is turned back: no mirror_torsion");
  if (scanner.hasMirrorAngle()) {
    refuse(ErrorSource::deflection_scale, " has scan_angle_scale in place of deflection_scale");
  } else {
    refuse(ErrorSource::encoder_quadratic, " has no mirror angle: no encoder_quadratic");
    refuse(ErrorSource::encoder_cubic, " has no mirror angle: no encoder_cubic");
    refuse(ErrorSource::encoder_sine, " has no mirror angle: no encoder_sine");
  }
  for (const ErrorSources::Entry& entry : options.errors.entries()) {
    const auto concerns = [&entry](const PlannedLine& line) {
      return entry.number == (entry.scope == ErrorScope::session ? line.session : line.id);
    };
    const bool known = entry.scope == ErrorScope::channel
                           ? entry.number < scanner.channels
                           : entry.scope == ErrorScope::block ||
                                 std::any_of(options.lines.begin(), options.lines.end(), concerns);
    if (!known)
      throw UsageError("simulation: error " + entry.name + ": there is no " + entry.scopeName());
  }
}

}  // namespace

NoiseOptions NoiseOptions::named(std::string_view level) {
  NoiseOptions noise;
  if (level == "none") return noise;
  noise.range = 0.02;
  if (level == "range") return noise;
  if (level != "realistic")
    throw UsageError("noise '" + std::string(level) + "': there are none, range, realistic");
  noise.scan_angle = 3.0 * kRadiansPerArcsec;
  noise.refraction = 3e-6;
  noise.position = 0.015;
  noise.roll_pitch = 8.0 * kRadiansPerArcsec;
  noise.heading = 16.0 * kRadiansPerArcsec;
  noise.intensity = 0.03;
  noise.control = 0.01;
  noise.footprint = true;
  return noise;
}

void NoiseOptions::setTrajectoryGrade(std::string_view grade) {
  struct Grade {
    std::string_view name;
    double position, roll_pitch, heading, seconds;  ///< m, arcsec, arcsec
  };
  constexpr Grade kGrades[] = {{"survey", 0.02, 9.0, 18.0, 60.0},
                               {"tactical", 0.03, 54.0, 126.0, 40.0},
                               {"mems", 0.04, 90.0, 288.0, 20.0}};
  for (const Grade& known : kGrades) {
    if (known.name != grade) continue;
    position = known.position;
    roll_pitch = known.roll_pitch * kRadiansPerArcsec;
    heading = known.heading * kRadiansPerArcsec;
    correlation_time = known.seconds;
    return;
  }
  throw UsageError("trajectory grade '" + std::string(grade) +
                   "': there are survey, tactical, mems");
}

void SimulationOptions::setScanner(std::string_view scanner_name) {
  scanner.setType(scanner_name);
  if (!scanner.hasMirrorAngle()) bias[indexOf(SystemParameter::scan_angle_scale)] = 0.0;
}

void SimulationOptions::setSessions(int count) {
  require(count, 1, std::min<double>(5.0, static_cast<double>(lines.size())), "number of sessions");
  for (std::size_t i = 0; i < lines.size(); ++i)
    lines[i].session = 1 + static_cast<int>(i * static_cast<std::size_t>(count) / lines.size());
}

void SimulationOptions::setGains(std::string_view list) {
  for (const std::string& part : splitList(list)) {
    const auto [id, text] = assignmentIn(part).value_or(std::pair(part, std::string()));
    const auto named =
        std::find_if(lines.begin(), lines.end(),
                     [&id = id](const PlannedLine& line) { return std::to_string(line.id) == id; });
    if (named == lines.end())
      throw UsageError("strip_gains '" + part + "' names no line (ID=FACTOR)");
    named->gain = finiteNumber(text).value_or(0.0);
    if (named->gain < 0.01 || named->gain > 100.0)
      throw UsageError("strip_gains '" + part + "': the factor is a number from 0.01 to 100");
  }
}

void SimulationOptions::check() const {
  constexpr double kLargest = 5.0 * kRadiansPerDegree;
  for (int i = 0; i < kSystemParameterCount; ++i) {
    const SystemParameterInfo& info = systemParameters()[static_cast<std::size_t>(i)];
    const double limit = info.unit == "arcsec" ? kLargest : info.unit == "m" ? 20.0 : 0.05;
    const double per_unit = info.internal_per_unit;
    const std::string name(info.name);
    require(bias[i] / per_unit, -limit / per_unit, limit / per_unit, "bias of " + name);
    require(mounting[i] / per_unit, -limit / per_unit, limit / per_unit, "true " + name);
  }
  require(origin.norm(), 0.0, 1e8, "distance of the origin (m)");
  require(start_time, 0.0, 604800.0, "start time (s of week)");
  require(trajectory_rate, 1.0, 2000.0, "trajectory rate (Hz)");
  require(line_interval, 0.0, 36000.0, "interval of lines (s)");
  require(attitude_amplitude, 0.0, kLargest, "attitude amplitude (rad)");
  require(mean_pitch, -kLargest, kLargest, "mean pitch (rad)");
  require(largest_crab, 0.0, 2.0 * kLargest, "crab (rad)");
  require(control_points, 0, 100000, "number of control points");
  require(targets, 0, 10000, "number of targets");
  require(target_diameter, 0.1, 20.0, "diameter of targets (m)");
  require(noise.range, 0.0, 1.0, "range noise (m)");
  require(noise.refraction, 0.0, 1e-3, "error of the refractive index");
  require(noise.scan_angle, 0.0, 0.01, "scan angle noise (rad)");
  require(noise.position, 0.0, 10.0, "position noise (m)");
  require(noise.roll_pitch, 0.0, 0.01, "roll and pitch noise (rad)");
  require(noise.heading, 0.0, 0.02, "heading noise (rad)");
  require(noise.correlation_time, 0.1, 1e5, "correlation time (s)");
  require(noise.intensity, 0.0, 1.0, "intensity noise");
  require(noise.control, 0.0, 1.0, "control noise (m)");
  require(scanner.field_of_view / kRadiansPerDegree, 1.0, 90.0, "field of view (degrees)");
  require(scanner.divergence, 0.0, 0.01, "beam divergence (rad)");
  require(scanner.max_returns, 1, 15, "largest number of returns");
  require(scanner.return_separation, 0.01, 20.0, "separation of returns (m)");
  require(scanner.detection_threshold, 0.0, 0.5, "detection threshold");
  require(scanner.gain, 1.0, 1e7, "gain");
  require(scanner.range_exponent, 0.0, 4.0, "range exponent");
  require(scanner.incidence_exponent, 0.0, 4.0, "incidence exponent");
  require(atmosphere.visibility_km, 0.1, 500.0, "visibility (km)");
  require(atmosphere.temperature_c, -60.0, 60.0, "temperature (C)");
  require(atmosphere.pressure_kpa, 20.0, 120.0, "pressure (kPa)");
  require(scene.relief, 0.0, 1.5, "relief factor");
  require(scene.mountains, 0.0, 400.0, "mountains (m)");
  require(scene.high_rises, 0.0, 1.0, "share of high-rises");
  require(scene.buildings, 0.0, 2.0, "buildings factor");
  require(scene.trees, 0.0, 4.0, "trees factor");
  require(scene.grass, 0.0, 1.0, "height of grass");
  if (waveform) waveform->check();
  if (lines.empty()) throw UsageError("simulation: no flight line is planned");
  for (const PlannedLine& line : lines) checkLine(line);
  checkErrors(*this);
}

}  // namespace pcl_als::simulation
