// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// simulate_lines FOLDER [LINES [MILLIONS [LENGTH]]]: parallel lines flown to and fro with half
// their swath in common, MILLIONS of pulses each, LENGTH metres long (default: ten lines of five
// million and 2500 m), as strip1.las … with trajectory.csv and control.csv: the blocks that
// pcl_als_check (quality.md) and a mission of eight hours (calibration.md) are timed with.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <pcl_als/processing/simulated_survey.h>
#include <pcl_als/simulation/simulator.h>

namespace {

using namespace pcl_als;

simulation::SimulationOptions linesOf(int count, double millions, double length) {
  constexpr double kHeight = 700.0, kOverlap = 0.5;
  simulation::SimulationOptions options = simulation::SimulationOptions::preset("small");
  options.name = "lines";
  options.noise = simulation::NoiseOptions::named("realistic");
  options.lines.clear();
  options.pairs.clear();
  const double swath = 2.0 * kHeight * std::tan(0.5 * options.scanner.field_of_view);
  for (int i = 0; i < count; ++i) {
    simulation::PlannedLine line;
    line.id = static_cast<std::uint16_t>(i + 1);
    const double aside = (i - 0.5 * (count - 1)) * (1.0 - kOverlap) * swath;
    const double half = (i % 2 == 0 ? 0.5 : -0.5) * length;
    line.start = Eigen::Vector2d(aside, -half);
    line.end = Eigen::Vector2d(aside, half);
    line.height = kHeight;
    line.density = 1e6 * millions / (length * swath);
    options.lines.push_back(line);
    if (i > 0) options.pairs.emplace_back(i, i + 1);
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 5) {
    std::fprintf(stderr, "simulate_lines FOLDER [LINES [MILLIONS [LENGTH]]]\n");
    return 1;
  }
  const int count = argc > 2 ? std::atoi(argv[2]) : 10;
  const double millions = argc > 3 ? std::atof(argv[3]) : 5.0;
  const double length = argc > 4 ? std::atof(argv[4]) : 2500.0;
  StripFileOptions files;
  files.folder = argv[1];
  std::filesystem::create_directories(files.folder);
  const simulation::Simulator simulator(linesOf(count, millions, length));
  for (std::size_t strip = 0; strip < simulator.stripCount(); ++strip) {
    const StripSummary written = writeStrip(simulator, strip, files, 0, [](double) {});
    std::printf("%s: %llu points\n", written.file.c_str(),
                static_cast<unsigned long long>(written.points));
  }
  writeSurveyFiles(simulator, files.folder);
  return 0;
}
