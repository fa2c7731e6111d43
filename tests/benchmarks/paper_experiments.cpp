// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// paper_experiments [-seeds FROM:TO] [-model quasi_rigorous|rigorous|vertical] [-noise N]
//
// Runs the four experiments of Habib et al. 2011 on simulated blocks of the same layout and prints
// their tables beside the paper's, as Markdown: I (all four pairs, no control), II (37 control
// points), III (one), IV (without pair 3&4, 37 control points). It judges nothing.
#include <cstdio>
#include <cstring>
#include <string>

#include <pcl_als/common/parallel.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "paper_tables.h"

namespace {

using namespace pcl_als;
using namespace pcl_als::bench;
using simulation::SimulatedPoint;
using simulation::SimulationOptions;
using Request = test::SimulatedSurvey::Request;

struct Options {
  int from = 1, to = 3;
  std::string model = "quasi_rigorous", noise = "realistic";
};

SimulationOptions blockOf(const Options& given, int seed) {
  SimulationOptions options = SimulationOptions::preset("paper");
  options.seed = static_cast<std::uint64_t>(seed);
  options.noise = simulation::NoiseOptions::named(given.noise);
  // The biases that the paper found, as round numbers.
  simulation::setBiases(
      "none,boresight_pitch=-29,boresight_roll=-90,boresight_heading=3,range_bias=0.12,"
      "scan_angle_scale=1e-4",
      options.bias);
  return options;
}

/// The point nearest to the middle of the block, where most strips see it.
ControlPoint nearestTo(const Eigen::Vector3d& centre, const std::vector<ControlPoint>& control) {
  ControlPoint nearest = control.front();
  const auto distance = [&](const ControlPoint& point) {
    return (point.position - centre).head<2>().norm();
  };
  for (const ControlPoint& point : control) {
    if (distance(point) < distance(nearest)) nearest = point;
  }
  return nearest;
}

Request requestOf(int experiment, const Options& given, const SimulationOptions& options,
                  const test::SimulatedSurvey& survey) {
  Request request;
  request.rigorous = given.model == "rigorous";
  request.settings.recover_attitude = given.model != "vertical";
  for (const auto& [a, b] : kPairs) {
    if (experiment == 3 && a == 3) continue;  // IV
    request.pairs.emplace_back(std::to_string(a), std::to_string(b));
  }
  if (experiment == 1 || experiment == 3) request.control = survey.control;
  if (experiment == 2) request.control = {nearestTo(options.origin, survey.control)};
  return request;
}

/// Errors of every hundredth point on solid ground and roofs against the surface that was hit.
void addCheckPoints(const SimulationOptions& options, const Trajectory& flight,
                    const std::vector<SystemVector>& states, PaperTables& tables) {
  constexpr std::size_t kEvery = 100;
  const simulation::Simulator simulator(options);
  std::vector<PointErrors> errors(states.size() + 1);
  std::size_t cursor = 0, number = 0;
  const auto add = [&](const std::vector<SimulatedPoint>& points) {
    for (const SimulatedPoint& point : points) {
      SensorPose pose;
      if (point.number_of_returns > 1 || point.classification == 5 || ++number % kEvery != 0 ||
          !flight.poseAt(point.time, pose, cursor))
        continue;
      for (std::size_t i = 0; i < states.size(); ++i)
        errors[i].add(corrected(pose, point.position, states[i]) - point.surface);
      errors.back().add(point.unbiased - point.surface);
    }
  };
  for (std::size_t strip = 0; strip < simulator.stripCount(); ++strip)
    simulator.simulateStrip(strip, 0, add);
  for (std::size_t i = 0; i < errors.size(); ++i) tables.addPoints(static_cast<int>(i), errors[i]);
}

void runSeed(const Options& given, int seed, PaperTables& tables) {
  const SimulationOptions options = blockOf(given, seed);
  const test::SimulatedSurvey survey(options);
  std::vector<SystemVector> states{SystemVector::Zero()};
  std::unique_ptr<MatchedBlock> block;
  for (int experiment = 0; experiment < kExperiments; ++experiment) {
    const Request request = requestOf(experiment, given, options, survey);
    const SurveyBlock chosen = survey.block(request);
    const CalibrationResult result = survey.calibrate(chosen).result;
    std::fprintf(stderr, "seed %d, experiment %s: %s\n", seed, kStateNames[experiment + 1],
                 result.converged ? "converged" : "NOT CONVERGED");
    tables.addResult(experiment, result);
    states.push_back(result.biases());
    if (experiment == 0) block = std::make_unique<MatchedBlock>(survey, chosen);
  }
  for (int state = 0; state < kStates; ++state) {
    block->correct(states[static_cast<std::size_t>(state)]);
    for (int pair = 0; pair < kPaperPairs; ++pair) {
      tables.addDiscrepancy(pair, state,
                            discrepancyOf(*block, kPairs[pair].first - 1, kPairs[pair].second - 1));
    }
  }
  addCheckPoints(options, block->flight(), states, tables);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const bool more = i + 1 < argc;
    if (std::strcmp(argv[i], "-model") == 0 && more) {
      options.model = argv[++i];
    } else if (std::strcmp(argv[i], "-noise") == 0 && more) {
      options.noise = argv[++i];
    } else if (std::strcmp(argv[i], "-seeds") != 0 || !more ||
               std::sscanf(argv[++i], "%d:%d", &options.from, &options.to) != 2) {
      std::fprintf(stderr, "unknown option %s\n", argv[i]);
      return 1;
    }
  }
  std::printf("The paper's block, %s noise, model %s, seeds %d to %d\n", options.noise.c_str(),
              options.model.c_str(), options.from, options.to);
  PaperTables tables(blockOf(options, options.from).bias);
  for (int seed = options.from; seed <= options.to; ++seed) runSeed(options, seed, tables);
  tables.print();
  return 0;
}
