// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// calibration_accuracy [-preset P] [-noise N] [-model rigorous|quasi_rigorous|vertical] [-vertical]
// [-random] [-seeds FROM:TO] [-density F] [-motion DEG] [-pitch DEG] [-crab DEG] [-bound]
// [-known_ranging] [-candidates N] [-budget N] [-against N] [-error_process NAME] [-scale F]
// [-lever_arm M]
//
// Simulates a block for every seed (-vertical: without attitude motion; -motion, -pitch, -crab:
// largest roll, mean pitch, largest crab; -random: with biases of its own, -lever_arm: their
// standard deviation; -scale: factor on the lengths of lines; -error_process: of the trajectory,
// see pcl_als_simulate), calibrates it and prints, as Markdown, what is wrong with each parameter
// beside what is said to be, how often the truth was inside the 68 % and 95 % intervals, what is
// left in the corrected points, and the time; with -bound also what the range noise alone would
// leave (FisherBound); with -known_ranging the instrument's range scale and its error on slopes are
// known to be zero. -candidates: points that look for patches; -budget: pairs that are adjusted;
// -against: calibrates each block again with that many candidates and no budget, and prints by how
// much the estimates differ. It judges nothing.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include <pcl_als/trajectory/scan_geometry.h>

#include "accuracy_table.h"
#include "simulated_survey.h"

namespace {

using namespace pcl_als;
using simulation::SimulationOptions;

struct Options {
  std::string preset = "paper", noise = "range", model = "quasi_rigorous", process = "gauss_markov";
  bool vertical = false, random = false, bound = false, known_ranging = false;
  int from = 1, to = 10;
  double density = 1.0, scale = 1.0;
  double lever_arm = 0.05;  ///< metres
  double candidates = 0, budget = 0, against = 0;
  double motion = 0.5, pitch = 1.0, crab = 3.0;  ///< degrees

  /// Takes one option with its value; how many arguments that were, 0 for none that is known.
  int take(const std::string& name, const char* value) {
    bool* const flag = name == "-vertical"        ? &vertical
                       : name == "-random"        ? &random
                       : name == "-bound"         ? &bound
                       : name == "-known_ranging" ? &known_ranging
                                                  : nullptr;
    if (flag != nullptr) {
      *flag = true;
      return 1;
    }
    if (value == nullptr) return 0;
    std::string* const text = name == "-preset"          ? &preset
                              : name == "-noise"         ? &noise
                              : name == "-model"         ? &model
                              : name == "-error_process" ? &process
                                                         : nullptr;
    double* const number = name == "-density"      ? &density
                           : name == "-scale"      ? &scale
                           : name == "-lever_arm"  ? &lever_arm
                           : name == "-motion"     ? &motion
                           : name == "-pitch"      ? &pitch
                           : name == "-crab"       ? &crab
                           : name == "-candidates" ? &candidates
                           : name == "-budget"     ? &budget
                           : name == "-against"    ? &against
                                                   : nullptr;
    if (text != nullptr) *text = value;
    if (number != nullptr) *number = std::atof(value);
    const bool known = text != nullptr || number != nullptr;
    return known || (name == "-seeds" && std::sscanf(value, "%d:%d", &from, &to) == 2) ? 2 : 0;
  }
};

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

/// Biases of a freshly mounted system, different for every seed.
SystemVector randomBiases(std::uint64_t seed, double lever_arm) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double sigma[kSystemParameterCount] = {lever_arm,
                                               lever_arm,
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

SimulationOptions blockOf(const Options& given, int seed) {
  SimulationOptions options = SimulationOptions::preset(given.preset, given.scale, given.density);
  options.seed = static_cast<std::uint64_t>(seed);
  options.noise = simulation::NoiseOptions::named(given.noise);
  options.noise.process = simulation::errorProcessNamed(given.process);
  options.vertical = given.vertical;
  options.attitude_amplitude = given.motion * kRadiansPerDegree;
  options.mean_pitch = given.pitch * kRadiansPerDegree;
  options.largest_crab = given.crab * kRadiansPerDegree;
  if (given.random) options.bias = randomBiases(options.seed, given.lever_arm);
  return options;
}

/// What other pairs of the same block say, and how many they were.
void printDifference(const Options& given, int seed, const test::SimulatedSurvey& survey,
                     test::SimulatedSurvey::Request request, const CalibrationResult& result,
                     bench::AccuracyTable& differences) {
  request.settings.candidates = static_cast<std::size_t>(given.against);
  request.settings.pair_budget = 0;
  const CalibrationResult other = survey.calibrate(request).result;
  char rest[80];
  std::snprintf(rest, sizeof rest, "%zu of %zu pairs", result.iterations.back().correspondences,
                other.iterations.back().correspondences);
  differences.printRow(std::to_string(seed) + ", difference", result, other.biases(), rest);
}

void runSeed(const Options& given, int seed, bench::AccuracyTable& table,
             bench::AccuracyTable& differences) {
  const SimulationOptions options = blockOf(given, seed);
  const test::SimulatedSurvey survey(options);
  test::SimulatedSurvey::Request request;
  request.settings.recover_attitude = given.model != "vertical";
  request.rigorous = given.model == "rigorous";
  request.control = survey.control;
  if (given.candidates > 0)
    request.settings.candidates = static_cast<std::size_t>(given.candidates);
  request.settings.pair_budget = static_cast<std::size_t>(given.budget);
  if (given.known_ranging) {
    for (SharedErrorModel::SourcePrior& prior : request.settings.shared_errors.sources)
      prior = {1e-10, 0.5};
    request.settings.diagnose = false;
  }
  const double start = secondsNow();
  const SurveyBlock chosen = survey.block(request);
  const CalibrationResult result = survey.calibrate(chosen).result;
  const double elapsed = secondsNow() - start;
  const auto [plan, height] =
      systematicError(simulation::Simulator(options), chosen.trajectory(), result.biases());
  char rest[80];
  std::snprintf(rest, sizeof rest, "%.4f / %.4f | %.1f", plan, height, elapsed);
  table.printRow(std::to_string(seed), result, survey.bias, rest);
  if (given.against > 0) printDifference(given, seed, survey, request, result, differences);
  if (!given.bound || options.noise.range == 0.0) return;
  bench::MatchedBlock block(survey, chosen);
  block.correct(survey.bias);
  table.addBound(bench::fisherBound(block, options.noise.range, result.correlation_order));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  for (int i = 1, taken = 0; i < argc; i += taken) {
    taken = options.take(argv[i], i + 1 < argc ? argv[i + 1] : nullptr);
    if (taken > 0) continue;
    std::fprintf(stderr, "unknown option %s\n", argv[i]);
    return 1;
  }
  std::printf("%s block, %s noise, %s, %s, model %s, seeds %d to %d: error (std)\n\n",
              options.preset.c_str(), options.noise.c_str(), options.process.c_str(),
              options.vertical ? "flown vertically" : "attitude motion and crab",
              options.model.c_str(), options.from, options.to);
  bench::AccuracyTable::printHeader();
  bench::AccuracyTable table, differences;
  for (int seed = options.from; seed <= options.to; ++seed)
    runSeed(options, seed, table, differences);
  table.printTotals();
  if (options.against <= 0) return 0;
  std::printf("\nDifferences to %.0f candidates\n\n", options.against);
  differences.printTotals();
  return 0;
}
