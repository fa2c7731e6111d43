// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// alignment_peers [-seeds FROM:TO] [-density F] [-threads N] [-method TEXT] [-repeat N]
//                 [-simpleicp PROGRAM] [-points N] [-pairs N]
// alignment_peers -strips SOURCE,TARGET FILE… [-swap] [-in_place] …
//
// Aligns two strips with IterativeClosestPatch and with other registrations, in turns, each in a
// process of its own: simulated pairs with a known motion (scene, flight and noise new for every
// seed; 2 cm range noise), or two strips of files as they are (-in_place: known to be where they
// belong). -points, -pairs: ICPatch's, instead of its defaults. Prints time, memory and, where it
// is known, the error, as Markdown; see alignment_peers.md.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <pcl_als/io/strip_loader.h>
#include <pcl_als/registration/iterative_closest_patch.h>
#include <pcl_als/registration/rigid_motion.h>
#include <pcl_als/simulation/simulator.h>

#include "alignment_methods.h"

namespace {

using namespace pcl_als;
using bench::Alignment;
using bench::AlignmentMethod;
using bench::Points;
using Eigen::Vector3d;

constexpr double kArcsecond = 4.84813681109536e-6;

struct Options {
  int from = 1, to = 1, threads = 2, repeat = 1, points = 0, pairs = 0;
  double density = 1.0;
  bool swap = false, in_place = false;
  std::string method, simpleicp, source, target;
  std::vector<std::filesystem::path> files;
};

/// Both clouds relative to one origin, and the motion that brings source onto target if known.
struct StripPair {
  Points source, target;
  Vector3d centroid = Vector3d::Zero();
  bool known = false;
  RigidMotion truth;
};

bool take(Options& options, const char* name, const char* value) {
  const std::string option = name;
  if (option == "-seeds") return std::sscanf(value, "%d:%d", &options.from, &options.to) == 2;
  if (option == "-density") return (options.density = std::atof(value)) > 0.0;
  if (option == "-threads") return (options.threads = std::atoi(value)) > 0;
  if (option == "-repeat") return (options.repeat = std::atoi(value)) > 0;
  if (option == "-points") return (options.points = std::atoi(value)) > 0;
  if (option == "-pairs") return (options.pairs = std::atoi(value)) > 0;
  if (option == "-method") return !(options.method = value).empty();
  if (option == "-simpleicp") return !(options.simpleicp = value).empty();
  if (option != "-strips") return false;
  const char* comma = std::strchr(value, ',');
  if (comma == nullptr) return false;
  options.source.assign(value, comma);
  options.target = comma + 1;
  return true;
}

bool parse(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "-swap") == 0) {
      options.swap = true;
    } else if (std::strcmp(argv[i], "-in_place") == 0) {
      options.in_place = true;
    } else if (argv[i][0] != '-') {
      options.files.emplace_back(argv[i]);
    } else if (i + 1 >= argc || !take(options, argv[i], argv[i + 1])) {
      std::fprintf(stderr, "alignment_peers: %s: unknown, or its value is\n", argv[i]);
      return false;
    } else {
      ++i;
    }
  }
  return options.files.empty() == options.source.empty();
}

Vector3d meanOf(const Points& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Eigen::Vector3f& p : points) sum += p.cast<double>();
  return sum / static_cast<double>(points.size());
}

/// 36 cm and up to 0.05 degrees: within reach of methods that pair points up to 1 m.
RigidMotion knownMotion(const Vector3d& centroid) {
  RigidMotion motion;
  motion.centroid = centroid;
  motion.shift = {0.2, -0.25, 0.15};
  motion.rotation = Vector3d(0.02, -0.03, 0.05) * 3600.0 * kArcsecond;
  return motion;
}

/// The two opposite lines over one another of the paper's block.
StripPair simulatedPair(int seed, double density) {
  auto options = simulation::SimulationOptions::preset("paper", 1.0, density);
  options.seed = static_cast<std::uint64_t>(seed);
  options.noise = simulation::NoiseOptions::named("range");
  options.bias.setZero();
  const simulation::Simulator simulator(options);
  StripPair pair;
  for (const std::size_t strip : {0, 1}) {
    Points& cloud = strip == 0 ? pair.source : pair.target;
    simulator.simulateStrip(strip, 0, [&](const std::vector<simulation::SimulatedPoint>& points) {
      for (const auto& p : points) cloud.emplace_back((p.position - options.origin).cast<float>());
    });
  }
  pair.known = true;
  pair.truth = knownMotion(meanOf(pair.target));
  pair.centroid = pair.truth.centroid;
  const RigidMotion back = pair.truth.inverse();
  const Eigen::Affine3d moving = back.transformation();
  for (Eigen::Vector3f& p : pair.source) p = (moving * p.cast<double>()).cast<float>();
  return pair;
}

Alignment registerOwn(const Points& source, const Points& target, const Options& options) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr clouds[2];
  for (const bool moving : {true, false}) {
    auto& cloud = clouds[moving ? 0 : 1];
    cloud.reset(new pcl::PointCloud<pcl::PointXYZ>);
    for (const Eigen::Vector3f& p : moving ? source : target)
      cloud->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
  }
  const auto start = std::chrono::steady_clock::now();
  IterativeClosestPatch<pcl::PointXYZ, pcl::PointXYZ, double> icpatch;
  icpatch.setNumberOfThreads(options.threads);
  if (options.points > 0) icpatch.setMaximumPoints(static_cast<std::size_t>(options.points));
  if (options.pairs > 0) icpatch.setMaximumPairs(static_cast<std::size_t>(options.pairs));
  icpatch.setInputSource(clouds[0]);
  icpatch.setInputTarget(clouds[1]);
  pcl::PointCloud<pcl::PointXYZ> aligned;
  icpatch.align(aligned);
  Alignment result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.motion = icpatch.getTransformation().matrix();
  result.converged = icpatch.hasConverged();
  for (int p = 0; p < 6; ++p) result.std[p] = icpatch.getResult().standardDeviation(p);
  for (int p = 0; p < 3; ++p) result.centroid[p] = icpatch.getResult().motion.centroid[p];
  return result;
}

AlignmentMethod ownMethod(const Options& options) {
  return {"pcl_als ICPatch", [options](const Points& source, const Points& target) {
            return registerOwn(source, target, options);
          }};
}

StripPair readPair(const Options& options) {
  StripPair pair;
  Vector3d origin = Vector3d::Zero();
  for (const Strip<>& strip : loadStrips(options.files)) {
    for (const bool source : {true, false}) {
      if (strip.id != (source != options.swap ? options.source : options.target)) continue;
      if (origin.isZero()) origin = strip.frame.origin;
      const Vector3d shift = strip.frame.origin - origin;
      for (const PointLidar& p : *strip.cloud)
        (source ? pair.source : pair.target).emplace_back(p.getVector3fMap() + shift.cast<float>());
    }
  }
  const Alignment own = bench::runAlone(ownMethod(options), pair.source, pair.target);
  pair.centroid = Vector3d(own.centroid[0], own.centroid[1], own.centroid[2]);
  pair.known = options.in_place;
  return pair;
}

void print(const std::string& pair, const std::string& method, const StripPair& strips,
           const Alignment& result) {
  Eigen::Affine3d motion;
  motion.matrix() = result.motion;
  const RigidMotion found = RigidMotion::about(strips.centroid, motion);
  Vector3d shift = found.shift * 1e3, turn = found.rotation / kArcsecond;
  if (strips.known) {
    shift -= strips.truth.shift * 1e3;
    turn -= strips.truth.rotation / kArcsecond;
  }
  std::printf(
      "| %s | %s%s | %.2f | %.2f | %.0f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f "
      "|\n",
      pair.c_str(), method.c_str(), result.converged ? "" : " (not converged)", result.seconds,
      result.cpu_seconds, result.megabytes, shift.x(), shift.y(), shift.z(), shift.norm(), turn.x(),
      turn.y(), turn.z(), turn.norm());
  if (result.std[0] > 0.0)
    std::printf(
        "| | reported standard deviation | | | | %.1f | %.1f | %.1f | | %.1f | %.1f | %.1f | |\n",
        result.std[0] * 1e3, result.std[1] * 1e3, result.std[2] * 1e3, result.std[3] / kArcsecond,
        result.std[4] / kArcsecond, result.std[5] / kArcsecond);
  std::fflush(stdout);
}

void compare(const std::string& name, const StripPair& pair, const Options& options) {
  std::vector<AlignmentMethod> methods{ownMethod(options)};
  for (AlignmentMethod& method : bench::otherMethods(options.threads, options.simpleicp))
    methods.push_back(std::move(method));
  methods.erase(std::remove_if(methods.begin(), methods.end(),
                               [&](const AlignmentMethod& method) {
                                 return method.name.find(options.method) == std::string::npos;
                               }),
                methods.end());
  std::vector<Alignment> best(methods.size());
  for (int round = 0; round < options.repeat; ++round) {
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const Alignment result = bench::runAlone(methods[i], pair.source, pair.target);
      if (round == 0 || result.seconds < best[i].seconds) best[i] = result;
    }
  }
  for (std::size_t i = 0; i < methods.size(); ++i) print(name, methods[i].name, pair, best[i]);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) return 1;
  std::printf(
      "| pair | method | s | CPU s | MB | XT mm | YT mm | ZT mm | shift mm | omega \" | phi \" | "
      "kappa \" "
      "| "
      "turn \" |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  if (!options.files.empty()) {
    const StripPair pair = readPair(options);
    compare(options.source + (options.swap ? " from " : " onto ") + options.target, pair, options);
    return 0;
  }
  for (int seed = options.from; seed <= options.to; ++seed) {
    const StripPair pair = simulatedPair(seed, options.density);
    compare("seed " + std::to_string(seed) + ", " + std::to_string(pair.source.size()) + " + " +
                std::to_string(pair.target.size()),
            pair, options);
  }
}
