// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// trajectory_reconstruction SEEDS PRESET[:HEIGHT[:TREES[:BUILDINGS[:DENSITY]]]]...: paths
// reconstructed from the points of simulated blocks beside two published methods; see
// trajectory_reconstruction.md.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/simulation/simulator.h>
#include <pcl_als/trajectory/trajectory_reconstruction.h>

#include "published_paths.h"
#include "simulated_survey.h"

namespace {

using namespace pcl_als;
using simulation::SimulationOptions;

/// Root mean squares of the errors of one method over all strips.
struct Errors {
  RunningStatistics east, north, up;
  std::size_t strips = 0;

  void add(const Eigen::Vector3d& error) {
    east.add(error.x());
    north.add(error.y());
    up.add(error.z());
  }
  std::string text() const {
    char line[120];
    if (east.count() == 0) return "-";
    std::snprintf(line, sizeof line, "%.3f %.3f %.3f", east.rms(), north.rms(), up.rms());
    return line;
  }
};

struct Comparison {
  Errors own, normalised, stated, rays, spline;
  std::size_t strips = 0;
  double seconds = 0.0;
};

/// The origin of the pulses as the points were computed: the delivered trajectory with the assumed
/// lever arm.
std::function<Eigen::Vector3d(double)> truthOf(const test::SimulatedSurvey& survey,
                                               const SimulationOptions& options) {
  const auto flight = survey.flight(true);
  const Eigen::Vector3d arm = (options.mounting + options.bias).head<3>();
  return [flight, arm](double time) -> Eigen::Vector3d {
    SensorPose pose;
    std::size_t cursor = 0;
    if (!flight->poseAt(time, pose, cursor)) return Eigen::Vector3d::Constant(NAN);
    return pose.position + pose.rotation * arm;
  };
}

void compare(const std::vector<TrajectorySample>& path,
             const std::function<Eigen::Vector3d(double)>& truth, Errors& errors) {
  ++errors.strips;
  for (const TrajectorySample& sample : path) {
    const Eigen::Vector3d error = sample.position - truth(sample.time);
    if (error.allFinite()) errors.add(error);
  }
}

void compareStrip(const std::vector<LidarReturn>& points,
                  const std::function<Eigen::Vector3d(double)>& truth, Comparison& sum) {
  const auto start = std::chrono::steady_clock::now();
  TrajectoryReconstruction reconstruction;
  reconstruction.add(reconstruction.addStrip("1"), points.data(), points.size());
  const std::vector<ReconstructedPath> paths = reconstruction.reconstruct();
  sum.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++sum.strips;
  for (const ReconstructedPath& path : paths) {
    if (!path.found) continue;
    ++sum.own.strips;
    for (const PathSample& sample : path.samples) {
      const Eigen::Vector3d error = sample.position - truth(sample.time);
      if (!error.allFinite()) continue;
      const Eigen::Vector3d std = sample.covariance.diagonal().cwiseSqrt();
      sum.own.add(error);
      sum.normalised.add(error.cwiseQuotient(std));
      sum.stated.add(std);
    }
  }
  compare(benchmark::intersectionOfRays(points), truth, sum.rays);
  compare(benchmark::splineOfRaysAndAngles(points, 0.1), truth, sum.spline);
}

/// PRESET:HEIGHT:TREES:BUILDINGS:DENSITY; 0 and missing values are those of the preset.
SimulationOptions blockOf(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
  const auto number = [&parts](std::size_t i, double otherwise) {
    return i < parts.size() && !parts[i].empty() ? std::atof(parts[i].c_str()) : otherwise;
  };
  SimulationOptions options = SimulationOptions::preset(parts.at(0), 1.0, number(4, 1.0));
  options.noise = simulation::NoiseOptions::named("realistic");
  options.scene.trees = number(2, options.scene.trees);
  options.scene.buildings = number(3, options.scene.buildings);
  if (const double height = number(1, 0.0); height > 0.0)
    for (simulation::PlannedLine& line : options.lines) line.height = height;
  return options;
}

void run(const std::string& block, int seeds) {
  Comparison sum;
  for (int seed = 1; seed <= seeds; ++seed) {
    SimulationOptions options = blockOf(block);
    options.seed = static_cast<std::uint64_t>(seed);
    const test::SimulatedSurvey survey(options);
    const auto truth = truthOf(survey, options);
    for (const std::vector<LidarReturn>& strip : survey.strips) compareStrip(strip, truth, sum);
  }
  std::printf("| %s | %zu of %zu | %s | %s | %s | %s | %s | %.3f |\n", block.c_str(),
              sum.own.strips, sum.strips, sum.own.text().c_str(), sum.stated.text().c_str(),
              sum.normalised.text().c_str(), sum.rays.text().c_str(), sum.spline.text().c_str(),
              sum.seconds / static_cast<double>(sum.strips));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: trajectory_reconstruction SEEDS PRESET[:HEIGHT[:TREES]]...\n");
    return 1;
  }
  std::printf(
      "| block | strips | RMS error east north up, m | stated std, m | error / std | rays in "
      "time bins, m | spline, m | s per strip |\n|---|---|---|---|---|---|---|---|\n");
  try {
    for (int i = 2; i < argc; ++i) run(argv[i], std::atoi(argv[1]));
  } catch (const Error& error) {
    std::fprintf(stderr, "trajectory_reconstruction: %s\n", error.what());
    return 2;
  }
  return 0;
}
