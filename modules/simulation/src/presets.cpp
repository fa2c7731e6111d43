// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/simulation_options.h>

namespace pcl_als::simulation {

namespace {

enum class Course { north, east, south, west };

/// Parallel lines over the middle of the block, each with its overlap with the one before.
struct LineGroup {
  double height, density, length;
  struct Line {
    Course course;
    double overlap;  ///< share of the swath; of the first: unused
  };
  std::vector<Line> lines;
  double speed = 60.0;
};

/// Factors of the caller on a preset.
struct Factors {
  double length, density, height;
};

bool isNorthSouth(Course course) {
  return course == Course::north || course == Course::south;
}

double swathOf(double height, const SimulationOptions& options) {
  return 2.0 * height * std::tan(0.5 * options.scanner.field_of_view);
}

/// Appends a group's lines with the next ids and the pairs of neighbours.
void append(LineGroup group, const Factors& factors, SimulationOptions& options) {
  group.height *= factors.height;
  group.density *= factors.density;
  group.length *= factors.length;
  const double swath = swathOf(group.height, options);
  double place = 0.0, width = 0.0;
  for (std::size_t i = 1; i < group.lines.size(); ++i)
    width += (1.0 - group.lines[i].overlap) * swath;
  for (std::size_t i = 0; i < group.lines.size(); ++i) {
    const auto [course, overlap] = group.lines[i];
    if (i > 0) place += (1.0 - overlap) * swath;
    const double aside = place - 0.5 * width;
    const bool forward = course == Course::north || course == Course::east;
    const double half = (forward ? 0.5 : -0.5) * group.length;
    PlannedLine line;
    line.id = static_cast<std::uint16_t>(options.lines.size() + 1);
    line.start =
        isNorthSouth(course) ? Eigen::Vector2d(aside, -half) : Eigen::Vector2d(-half, aside);
    line.end = isNorthSouth(course) ? Eigen::Vector2d(aside, half) : Eigen::Vector2d(half, aside);
    line.height = group.height;
    line.density = group.density;
    line.speed = group.speed;
    options.lines.push_back(line);
    if (i > 0) options.pairs.emplace_back(line.id - 1, line.id);
  }
}

void paper(const Factors& factors, SimulationOptions& options) {
  append({1150.0, 1.5, 2000.0, {{Course::south, 0.0}, {Course::north, 0.80}}}, factors, options);
  append({540.0,
          3.7,
          1000.0,
          {{Course::west, 0.0}, {Course::east, 0.25}, {Course::west, 0.75}, {Course::west, 0.50}}},
         factors, options);
}

void small(const Factors& factors, SimulationOptions& options) {
  append({1150.0, 0.5, 450.0, {{Course::south, 0.0}, {Course::north, 0.80}}}, factors, options);
  append({540.0, 1.0, 450.0, {{Course::west, 0.0}, {Course::east, 0.75}, {Course::east, 0.50}}},
         factors, options);
}

/// A drone: lines 30 m apart (at 75 m), flown alternately in both directions.
void drone(double height, const Factors& factors, SimulationOptions& options) {
  const double overlap = 1.0 - 30.0 * height / 75.0 / swathOf(height, options);
  LineGroup group{height, 9.0, 220.0, {}, 6.0};
  for (int i = 0; i < 8; ++i)
    group.lines.push_back({i % 2 == 0 ? Course::west : Course::east, overlap});
  append(group, factors, options);
  options.scene.relief = 0.2;  // below the flight
  options.scanner.gain = 100.0;
}

/// Two heights, two directions; for the scanners that look ahead and back.
void crossed(const Factors& factors, SimulationOptions& options) {
  append({1100.0, 0.7, 600.0, {{Course::south, 0.0}, {Course::north, 0.80}}}, factors, options);
  append({550.0, 1.5, 600.0, {{Course::west, 0.0}, {Course::east, 0.75}, {Course::east, 0.50}}},
         factors, options);
}

/// A helicopter along a line with bends: consecutive strips overlap at their ends only, and two
/// strips flown back overlap them along a narrow band.
void corridor(const Factors& factors, SimulationOptions& options) {
  constexpr double kHeight = 200.0, kBand = 0.15;
  const double swath = swathOf(kHeight * factors.height, options);
  const double length = 430.0 * factors.length, beyond = 0.3 * swath;
  Eigen::Vector2d corner = -length * Eigen::Vector2d(1.8, 0.9);
  std::vector<PlannedLine> back;
  for (const double degrees : {40.0, 75.0, 50.0, 100.0}) {
    const double heading = degrees * kRadiansPerDegree;
    const Eigen::Vector2d course(std::sin(heading), std::cos(heading));
    PlannedLine line;
    line.id = static_cast<std::uint16_t>(options.lines.size() + 1);
    line.start = corner - beyond * course;
    corner += length * course;
    line.end = corner + beyond * course;
    line.height = kHeight * factors.height;
    line.density = 3.0 * factors.density;
    line.speed = 25.0;
    options.lines.push_back(line);
    if (line.id > 1) options.pairs.emplace_back(line.id - 1, line.id);
    const Eigen::Vector2d aside = (1.0 - kBand) * swath * Eigen::Vector2d(course.y(), -course.x());
    line.start += aside;
    line.end += aside;
    std::swap(line.start, line.end);
    if (line.id == 2 || line.id == 3) back.push_back(line);
  }
  for (PlannedLine& line : back) {
    options.pairs.emplace_back(line.id, options.lines.size() + 1);
    line.id = static_cast<std::uint16_t>(options.lines.size() + 1);
    options.lines.push_back(line);
  }
  options.scene.relief = 0.6;
  options.scanner.gain = 400.0;
}

void mountain(const Factors& factors, SimulationOptions& options) {
  constexpr double kSpeed = 70.0;
  append({1300.0, 0.5, 1500.0, {{Course::south, 0.0}, {Course::north, 0.50}}, kSpeed}, factors,
         options);
  append({1800.0, 0.4, 1500.0, {{Course::north, 0.0}}, kSpeed}, factors, options);
  append({1500.0, 0.5, 1500.0, {{Course::west, 0.0}, {Course::east, 0.60}}, kSpeed}, factors,
         options);
  options.scene.mountains = 200.0;
  options.scene.relief = 0.6;
}

void city(const Factors& factors, SimulationOptions& options) {
  append({900.0, 2.0, 500.0, {{Course::south, 0.0}, {Course::north, 0.60}, {Course::south, 0.60}}},
         factors, options);
  append({650.0, 2.5, 500.0, {{Course::west, 0.0}, {Course::east, 0.75}}}, factors, options);
  options.scene.relief = 0.3;
  options.scene.high_rises = 0.8;
}

struct Preset {
  const char* scanner;
  double field_of_view;  ///< degrees
  std::function<void(const Factors&, SimulationOptions&)> plan;
};

const std::map<std::string_view, Preset>& presets() {
  static const std::map<std::string_view, Preset> kPresets = {
      {"paper", {"oscillating", 40.0, paper}},
      {"small", {"oscillating", 40.0, small}},
      {"uav",
       {"oscillating", 70.0,
        [](const Factors& f, SimulationOptions& options) { drone(75.0, f, options); }}},
      {"corridor", {"polygon", 60.0, corridor}},
      {"conical", {"conical", 40.0, crossed}},
      {"dual", {"dual", 40.0, crossed}},
      {"rosette",
       {"rosette", 70.0,
        [](const Factors& f, SimulationOptions& options) { drone(70.0, f, options); }}},
      {"mountain", {"cross", 58.0, mountain}},
      {"city", {"polygon", 40.0, city}},
  };
  return kPresets;
}

void requireFactor(double value, double low, double high, const char* name) {
  if (value >= low && value <= high) return;
  throw UsageError(std::string(name) + " " + std::to_string(value) + " is outside [" +
                   std::to_string(low) + ", " + std::to_string(high) + "]");
}

}  // namespace

SimulationOptions SimulationOptions::preset(std::string_view name, double scale, double density,
                                            double field_of_view, double height) {
  requireFactor(scale, 0.05, 10.0, "scale");
  requireFactor(density, 0.01, 50.0, "density");
  requireFactor(height, 0.1, 10.0, "height");
  const auto found = presets().find(name);
  if (found == presets().end()) {
    std::string names;
    for (const auto& [known, preset] : presets())
      names += (names.empty() ? "" : ", ") + std::string(known);
    throw UsageError("preset '" + std::string(name) + "': there are " + names);
  }
  const Preset& chosen = found->second;
  SimulationOptions options;
  options.name = name;
  setBiases(
      "lever_arm_x=0.05,lever_arm_y=-0.05,boresight_pitch=-30,boresight_roll=-90,"
      "boresight_heading=40,range_bias=0.12,scan_angle_scale=1e-4",
      options.bias);
  options.setScanner(chosen.scanner);
  options.scanner.field_of_view =
      field_of_view != 0.0 ? field_of_view : chosen.field_of_view * kRadiansPerDegree;
  requireFactor(options.scanner.field_of_view / kRadiansPerDegree, 1.0, 90.0,
                "field of view (degrees)");
  chosen.plan({scale, density, height}, options);
  return options;
}

}  // namespace pcl_als::simulation
