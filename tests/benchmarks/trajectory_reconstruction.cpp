// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// trajectory_reconstruction SEEDS PRESET[:HEIGHT[:TREES[:BUILDINGS[:DENSITY[:EXACT]]]]]...: paths
// reconstructed from the points of simulated blocks beside two published methods; see
// trajectory_reconstruction.md.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
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
  std::array<RunningStatistics, 3> axes;
  std::size_t strips = 0;

  void add(const Eigen::Vector3d& error) {
    for (std::size_t c = 0; c < 3; ++c) axes[c].add(error[static_cast<int>(c)]);
  }
  double rms(std::size_t axis) const { return axes[axis].rms(); }
  /// Of the three coordinates together.
  double rms() const { return std::hypot(rms(0), rms(1), rms(2)); }
  std::string text(int digits) const {
    char line[120];
    if (axes[0].count() == 0) return "-";
    std::snprintf(line, sizeof line, "%.*f %.*f %.*f", digits, rms(0), digits, rms(1), digits,
                  rms(2));
    return line;
  }
};

/// The error of the first over that of the better of the others, by coordinate and of the whole.
std::string shares(const Errors& own, const std::vector<const Errors*>& others) {
  if (own.axes[0].count() == 0 || others.front()->axes[0].count() == 0) return "-";
  const auto best = [&others](const auto& of) {
    double least = of(*others.front());
    for (const Errors* other : others) least = std::min(least, of(*other));
    return least;
  };
  std::string text;
  char number[40];
  for (std::size_t c = 0; c < 3; ++c) {
    const auto axis = [c](const Errors& errors) { return errors.rms(c); };
    std::snprintf(number, sizeof number, "%.2f ", own.rms(c) / best(axis));
    text += number;
  }
  std::snprintf(number, sizeof number, "(%.2f)",
                own.rms() / best([](const Errors& errors) { return errors.rms(); }));
  return text + number;
}

/// \a common: at the times at which rays in time bins give a position.
struct Comparison {
  Errors own, normalised, stated, spline, common_own, common_rays, common_spline;
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

using Truth = std::function<Eigen::Vector3d(double)>;
/// Errors of a path by multiples of kStep.
using ErrorsByTime = std::map<std::int64_t, Eigen::Vector3d>;

constexpr double kStep = 0.05;  // seconds; the middles of the time bins are multiples of it

template <typename Samples>
ErrorsByTime errorsOf(const Samples& path, const Truth& truth) {
  ErrorsByTime errors;
  for (const auto& sample : path) {
    const Eigen::Vector3d error = sample.position - truth(sample.time);
    if (error.allFinite()) errors[std::llround(sample.time / kStep)] = error;
  }
  return errors;
}

void addAll(const ErrorsByTime& errors, Errors& sum) {
  for (const auto& entry : errors) sum.add(entry.second);
}

ErrorsByTime reconstruct(const std::vector<LidarReturn>& points, const Truth& truth,
                         Comparison& sum) {
  const auto start = std::chrono::steady_clock::now();
  TrajectoryReconstruction::Settings settings;
  settings.interval = kStep;
  TrajectoryReconstruction reconstruction(settings);
  reconstruction.add(reconstruction.addStrip("1"), points.data(), points.size());
  const std::vector<ReconstructedPath> paths = reconstruction.reconstruct();
  sum.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++sum.strips;
  ErrorsByTime errors;
  for (const ReconstructedPath& path : paths) {
    if (!path.found) continue;
    ++sum.own.strips;
    const ErrorsByTime of_path = errorsOf(path.samples, truth);
    for (const PathSample& sample : path.samples) {
      const auto error = of_path.find(std::llround(sample.time / kStep));
      if (error == of_path.end()) continue;
      const Eigen::Vector3d std = sample.covariance.diagonal().cwiseSqrt();
      sum.own.add(error->second);
      sum.normalised.add(error->second.cwiseQuotient(std));
      sum.stated.add(std);
    }
    errors.insert(of_path.begin(), of_path.end());
  }
  return errors;
}

void compareStrip(const std::vector<LidarReturn>& points, const Truth& truth, Comparison& sum) {
  const ErrorsByTime own = reconstruct(points, truth, sum);
  const ErrorsByTime rays = errorsOf(benchmark::intersectionOfRays(points), truth);
  const ErrorsByTime spline = errorsOf(benchmark::splineOfRaysAndAngles(points, kStep), truth);
  addAll(spline, sum.spline);
  for (const auto& [time, error] : rays) {
    const auto a = own.find(time), b = spline.find(time);
    if (a == own.end() || b == spline.end()) continue;
    sum.common_own.add(a->second);
    sum.common_rays.add(error);
    sum.common_spline.add(b->second);
  }
}

/// PRESET:HEIGHT:TREES:BUILDINGS:DENSITY:EXACT; 0 and missing values are those of the preset, EXACT
/// is 1 for a delivered trajectory without errors.
SimulationOptions blockOf(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ':');) parts.push_back(part);
  const auto number = [&parts](std::size_t i, double otherwise) {
    return i < parts.size() && !parts[i].empty() ? std::atof(parts[i].c_str()) : otherwise;
  };
  SimulationOptions options = SimulationOptions::preset(parts.at(0), 1.0, number(4, 1.0));
  options.noise = simulation::NoiseOptions::named("realistic");
  if (number(5, 0.0) > 0.0)
    options.noise.position = options.noise.roll_pitch = options.noise.heading = 0.0;
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
  std::printf("| %s | %zu of %zu | %s | %s | %s | %s | %s | %s | %s | %s | %s | %.3f |\n",
              block.c_str(), sum.own.strips, sum.strips, sum.own.text(4).c_str(),
              sum.stated.text(4).c_str(), sum.normalised.text(2).c_str(),
              sum.spline.text(4).c_str(), shares(sum.own, {&sum.spline}).c_str(),
              sum.common_own.text(4).c_str(), sum.common_rays.text(4).c_str(),
              sum.common_spline.text(4).c_str(),
              shares(sum.common_own, {&sum.common_rays, &sum.common_spline}).c_str(),
              sum.seconds / static_cast<double>(sum.strips));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr,
                 "usage: trajectory_reconstruction SEEDS PRESET[:HEIGHT[:TREES[:...]]]...\n");
    return 1;
  }
  std::printf(
      "| block | strips | RMS error east north up, m | stated std, m | error / std | spline, m | "
      "own / spline | common times: own, m | rays in time bins, m | spline, m | own / better | s "
      "per "
      "strip |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  try {
    for (int i = 2; i < argc; ++i) run(argv[i], std::atoi(argv[1]));
  } catch (const Error& error) {
    std::fprintf(stderr, "trajectory_reconstruction: %s\n", error.what());
    return 2;
  }
  return 0;
}
