// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <string>

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

bool isNorthSouth(Course course) {
  return course == Course::north || course == Course::south;
}

/// Appends a group's lines with the next ids and the pairs of neighbours.
void append(const LineGroup& group, SimulationOptions& options) {
  const double swath = 2.0 * group.height * std::tan(0.5 * options.scanner.field_of_view);
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

void requireFactor(double value, double low, double high, const char* name) {
  if (value >= low && value <= high) return;
  throw UsageError(std::string(name) + " " + std::to_string(value) + " is outside [" +
                   std::to_string(low) + ", " + std::to_string(high) + "]");
}

}  // namespace

SimulationOptions SimulationOptions::preset(std::string_view name, double scale, double density,
                                            double field_of_view) {
  requireFactor(scale, 0.05, 10.0, "scale");
  requireFactor(density, 0.01, 50.0, "density");
  requireFactor(field_of_view / kRadiansPerDegree, 1.0, 75.0, "field of view (degrees)");
  SimulationOptions options;
  options.name = name;
  options.scanner.field_of_view = field_of_view;
  if (name == "paper") {
    append({1150.0, 1.5 * density, 2000.0 * scale, {{Course::south, 0.0}, {Course::north, 0.80}}},
           options);
    append(
        {540.0,
         3.7 * density,
         1000.0 * scale,
         {{Course::west, 0.0}, {Course::east, 0.25}, {Course::west, 0.75}, {Course::west, 0.50}}},
        options);
  } else if (name == "small") {
    append({1150.0, 0.5 * density, 450.0 * scale, {{Course::south, 0.0}, {Course::north, 0.80}}},
           options);
    append({540.0,
            1.0 * density,
            450.0 * scale,
            {{Course::west, 0.0}, {Course::east, 0.75}, {Course::east, 0.50}}},
           options);
  } else if (name == "uav") {
    // Lines 30 m apart, flown alternately in both directions.
    constexpr double kHeight = 75.0, kSpacing = 30.0;
    const double overlap = 1.0 - kSpacing / (2.0 * kHeight * std::tan(0.5 * field_of_view));
    LineGroup group{kHeight, 9.0 * density, 220.0 * scale, {}, 6.0};
    for (int i = 0; i < 8; ++i)
      group.lines.push_back({i % 2 == 0 ? Course::west : Course::east, overlap});
    append(group, options);
    options.scene.relief = 0.2;  // below the flight
  } else {
    throw UsageError("preset '" + std::string(name) + "': there are paper, small and uav");
  }
  setBiases(
      "lever_arm_x=0.05,lever_arm_y=-0.05,boresight_pitch=-30,boresight_roll=-90,"
      "boresight_heading=40,range_bias=0.12,scan_angle_scale=1e-4",
      options.bias);
  return options;
}

}  // namespace pcl_als::simulation
