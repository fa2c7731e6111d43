// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// point_uncertainty FOLDER [PRESET [FROM [TO [DENSITY [INS [SCALE [PROCESS]]]]]]]
//
// Simulates blocks with realistic noise for the seeds FROM to TO, calibrates them, corrects their
// points through files in FOLDER, and prints, as Markdown, the true errors of the points over their
// standard deviations (sigma_horizontal, sigma_vertical) by flying height and slope: without and
// with strip corrections, and those of the corrected trajectory. INS: grade of the simulated
// trajectory errors, which is also given to the calibration (-: those of realistic noise). See
// point_uncertainty.md.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "uncertainty_check.h"

namespace {

using namespace pcl_als;

void print(const char* title, const test::UncertaintyTable& table) {
  std::printf(
      "\n%s\n\n| height m | slope | points | horizontal: RMS error m | sigma m | error / "
      "sigma | vertical: RMS error m | sigma m | error / sigma |\n|---|---|---|---|---|---|"
      "---|---|---|\n",
      title);
  for (const auto& [key, e] : table) {
    const char* slope = key.second == 10 ? "under 10" : key.second == 25 ? "10 to 25" : "over 25";
    std::printf("| %d | %s | %.0f | %.4f | %.4f | **%.2f** | %.4f | %.4f | **%.2f** |\n", key.first,
                slope, e.count, e.rms(e.error_horizontal), e.rms(e.sigma_horizontal),
                e.rms(e.horizontal), e.rms(e.error_vertical), e.rms(e.sigma_vertical),
                e.rms(e.vertical));
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int i, const char* otherwise) {
    return std::string(argc > i ? argv[i] : otherwise);
  };
  const std::string folder = argument(1, ".");
  const int from = std::atoi(argument(3, "1").c_str()), to = std::atoi(argument(4, "5").c_str());
  test::UncertaintyTable plain, strips;
  test::NormalisedErrors paths;
  for (int seed = from; seed <= to; ++seed) {
    auto options = simulation::SimulationOptions::preset(argument(2, "small"),
                                                         std::atof(argument(7, "1").c_str()),
                                                         std::atof(argument(5, "0.3").c_str()));
    options.noise = simulation::NoiseOptions::named("realistic");
    CalibrationSettings settings;
    if (argc > 6 && argument(6, "") != "-") {
      options.noise.setTrajectoryGrade(argument(6, ""));
      settings.shared_errors = SharedErrorModel::ofGrade(argument(6, ""));
    }
    options.noise.process = simulation::errorProcessNamed(argument(8, "gauss_markov"));
    options.seed = static_cast<std::uint64_t>(seed);
    const test::UncertaintyBlock block(options, folder, settings);
    test::UncertaintyTable own_plain, own_strips;
    block.add(false, ".las", own_plain);
    block.add(true, ".las", own_strips);
    const test::NormalisedErrors path = block.trajectoryErrors();
    test::NormalisedErrors a, b;
    for (const auto& [key, e] : own_plain) plain[key].merge(e), a.merge(e);
    for (const auto& [key, e] : own_strips) strips[key].merge(e), b.merge(e);
    if (path.count > 0.0) paths.merge(path);
    const ErrorLevels levels = block.calibration.error_levels.value_or(ErrorLevels());
    std::printf(
        "seed %d: %s; range %.4f m, angle %.1f\", footprint %.1f\"; error / sigma %.2f %.2f, "
        "with strip corrections %.2f %.2f, path %.2f %.2f\n",
        seed, std::string(toString(block.calibration.verdict.status)).c_str(), levels.range,
        levels.angle / kRadiansPerArcsec, levels.footprint / kRadiansPerArcsec, a.rms(a.horizontal),
        a.rms(a.vertical), b.rms(b.horizontal), b.rms(b.vertical), path.rms(path.horizontal),
        path.rms(path.vertical));
    std::fflush(stdout);
  }
  print("Without strip corrections", plain);
  print("With strip corrections", strips);
  std::printf(
      "\nCorrected trajectory: error / sigma %.2f horizontally, %.2f vertically "
      "(RMS error %.4f m, %.4f m)\n",
      paths.rms(paths.horizontal), paths.rms(paths.vertical), paths.rms(paths.error_horizontal),
      paths.rms(paths.error_vertical));
  return 0;
}
