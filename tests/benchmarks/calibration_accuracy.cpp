// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// calibration_accuracy [-preset P] [-noise N] [-model rigorous|quasi_rigorous|vertical] [-vertical]
// [-random] [-seeds FROM:TO] [-density F]: simulates a block for every seed (-vertical: without
// attitude motion; -random: with biases of its own), calibrates it and prints, as Markdown, what is
// wrong with each parameter beside what is said to be, how often the truth was inside the 68 % and
// 95 % intervals, what is left in the corrected points, and the time. It judges nothing.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>

#include <pcl_als/trajectory/scan_geometry.h>

#include "simulated_survey.h"

namespace {

using namespace pcl_als;
using simulation::SimulationOptions;

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Mean of what is left of the biases in the first strip (the highest flight line): plan and
/// height, metres.
std::pair<double, double> systematicError(const simulation::Simulator& simulator,
                                          const Trajectory& trajectory,
                                          const SystemVector& biases) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  std::size_t cursor = 0;
  simulator.simulateStrip(0, 0, [&](const std::vector<simulation::SimulatedPoint>& points) {
    for (const simulation::SimulatedPoint& point : points) {
      SensorPose pose;
      if (!trajectory.poseAt(point.time, pose, cursor)) continue;
      sum += corrected(pose, point.position, biases) - point.unbiased;
      count += 1.0;
    }
  });
  sum /= count;
  return {sum.head<2>().norm(), std::abs(sum.z())};
}

struct Totals {
  SystemVector squares = SystemVector::Zero(), largest = SystemVector::Zero(),
               standardised = SystemVector::Zero(), inside_68 = SystemVector::Zero(),
               inside_95 = SystemVector::Zero();
  SystemVector count = SystemVector::Zero();
};

void printRow(const CalibrationResult& result, const SystemVector& truth, Totals& totals) {
  for (const SystemParameterInfo& info : systemParameters()) {
    const int i = indexOf(info.parameter);
    const ParameterEstimate& estimate = result[info.parameter];
    if (info.parameter == SystemParameter::lever_arm_z) continue;
    if (estimate.status != ParameterStatus::estimated) {
      std::printf(" held |");
      continue;
    }
    const double error = (estimate.bias - truth[i]) / info.internal_per_unit;
    std::printf(" %.2g (%.2g) |", error, estimate.std / info.internal_per_unit);
    totals.squares[i] += error * error;
    totals.largest[i] = std::max(totals.largest[i], std::abs(error));
    const double standardised = std::abs(estimate.bias - truth[i]) / estimate.std;
    totals.standardised[i] += standardised * standardised;
    if (standardised < 0.9945) totals.inside_68[i] += 1.0;
    if (standardised < 1.96) totals.inside_95[i] += 1.0;
    totals.count[i] += 1.0;
  }
}

void printTotals(const char* name, const SystemVector& values) {
  std::printf("| %s |", name);
  for (const SystemParameterInfo& info : systemParameters()) {
    if (info.parameter != SystemParameter::lever_arm_z)
      std::printf(" %.2g |", values[indexOf(info.parameter)]);
  }
  std::printf(" | |\n");
}

/// Biases of a freshly mounted system, different for every seed.
SystemVector randomBiases(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double sigma[kSystemParameterCount] = {0.05,
                                               0.05,
                                               0.0,
                                               100.0 * kRadiansPerArcsec,
                                               100.0 * kRadiansPerArcsec,
                                               100.0 * kRadiansPerArcsec,
                                               0.1,
                                               1e-4};
  SystemVector biases;
  for (int i = 0; i < kSystemParameterCount; ++i) biases[i] = sigma[i] * normal(random);
  return biases;
}

}  // namespace

int main(int argc, char** argv) {
  std::string preset = "paper", noise = "range";
  std::string model = "quasi_rigorous";
  bool vertical = false, random = false;
  int from = 1, to = 10;
  double density = 1.0;
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (std::strcmp(argv[i], "-vertical") == 0) {
      vertical = true;
    } else if (std::strcmp(argv[i], "-random") == 0) {
      random = true;
    } else if (std::strcmp(argv[i], "-model") == 0 && more) {
      model = argv[++i];
    } else if (std::strcmp(argv[i], "-preset") == 0 && more) {
      preset = argv[++i];
    } else if (std::strcmp(argv[i], "-noise") == 0 && more) {
      noise = argv[++i];
    } else if (std::strcmp(argv[i], "-density") == 0 && more) {
      density = std::atof(argv[++i]);
    } else if (std::strcmp(argv[i], "-seeds") != 0 || !more ||
               std::sscanf(argv[++i], "%d:%d", &from, &to) != 2) {
      std::fprintf(stderr, "unknown option %s\n", argv[i]);
      return 1;
    }
  }
  std::printf("%s block, %s noise, %s, model %s, seeds %d to %d: error (std)\n\n", preset.c_str(),
              noise.c_str(), vertical ? "flown vertically" : "attitude motion and crab",
              model.c_str(), from, to);
  std::printf(
      "| seed | dX m | dY m | pitch \" | roll \" | heading \" | dr m | dS | plan / height m | s "
      "|\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
  Totals totals;
  for (int seed = from; seed <= to; ++seed) {
    SimulationOptions options = SimulationOptions::preset(preset, 1.0, density);
    options.seed = static_cast<std::uint64_t>(seed);
    options.noise = simulation::NoiseOptions::named(noise);
    options.vertical = vertical;
    if (random) options.bias = randomBiases(options.seed);
    const test::SimulatedSurvey survey(options);
    CalibrationSettings settings;
    settings.recover_attitude = model != "vertical";
    std::shared_ptr<const Trajectory> flight;
    const double start = secondsNow();
    const CalibrationResult result = survey.calibrate(settings, true, model == "rigorous", &flight);
    const double elapsed = secondsNow() - start;
    const auto [plan, height] =
        systematicError(simulation::Simulator(options), *flight, result.biases());
    std::printf("| %d%s |", seed, result.converged ? "" : " (not converged)");
    printRow(result, survey.bias, totals);
    std::printf(" %.4f / %.4f | %.1f |\n", plan, height, elapsed);
    std::fflush(stdout);
  }
  printTotals("RMS", (totals.squares.array() / totals.count.array()).sqrt());
  printTotals("largest", totals.largest);
  printTotals("RMS / std", (totals.standardised.array() / totals.count.array()).sqrt());
  printTotals("in 68 %", totals.inside_68.array() / totals.count.array());
  printTotals("in 95 %", totals.inside_95.array() / totals.count.array());
  return 0;
}
