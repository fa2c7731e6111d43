// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/simulation/lidar_system.h>
#include <pcl_als/simulation/radiometry.h>
#include <pcl_als/simulation/simulator.h>

#include "block.h"
#include "flown_line.h"
#include "pulse_tracer.h"
#include "random.h"

namespace pcl_als::simulation {

namespace {

constexpr std::uint64_t kChunkPulses = 16384;
/// Share of an echo's spread in range that appears as timing noise.
constexpr double kSpreadNoise = 0.1;

// Bits of PointFlag (common/point_types.h), whose header would bring in PCL.
constexpr std::uint8_t kScanDirectionBit = 16, kEdgeBit = 32;

Scene makeScene(const SimulationOptions& options) {
  options.check();
  const auto [lower, upper] = sceneRectangle(options);
  return Scene(lower, upper, options.scene, options.seed);
}

std::vector<FlownLine> fly(const SimulationOptions& options) {
  Random random(keyOf({options.seed, 0x317D}));
  // Oblique to east and north, so that lines along both crab.
  const double wind = kRadiansPerDegree *
                      (90.0 * std::floor(random.uniform(0.0, 4.0)) + random.uniform(30.0, 60.0));
  std::vector<FlownLine> lines;
  double time = options.start_time;
  for (const PlannedLine& plan : options.lines) {
    lines.emplace_back(plan, options, time, wind);
    time = std::ceil(lines.back().lastTime() + options.line_interval);
  }
  return lines;
}

/// Data common to all pulses of a block.
struct Instrument {
  explicit Instrument(const SimulationOptions& options)
      : true_system(options.mounting),
        assumed_system(options.mounting + options.bias),
        extinction(extinctionPerKilometre(options.atmosphere)) {}
  LidarSystem true_system, assumed_system;
  double extinction;
};

/// Fires the pulses of one chunk.
class PulseRun {
 public:
  PulseRun(const SimulationOptions& options, const Instrument& instrument, const Scene& scene,
           const FlownLine& line)
      : options_(options),
        instrument_(instrument),
        line_(line),
        pattern_(line, options.scanner.field_of_view),
        tracer_(scene, options.scanner, options.noise.footprint) {}

  void fire(std::uint64_t pulse, std::vector<SimulatedPoint>& points);

 private:
  struct Shot;
  void record(const Shot& shot, const Echo& echo, Random& random, SimulatedPoint& point) const;

  const SimulationOptions& options_;
  const Instrument& instrument_;
  const FlownLine& line_;
  ScanPattern pattern_;
  PulseTracer tracer_;
};

/// A pulse as it was fired, and as position, attitude and encoder report it.
struct PulseRun::Shot {
  Eigen::Vector3d true_origin, true_direction;
  Eigen::Vector3d unbiased_origin, unbiased_direction;  ///< reported, with the true parameters
  Eigen::Vector3d assumed_origin, assumed_direction;
};

void PulseRun::fire(std::uint64_t pulse, std::vector<SimulatedPoint>& points) {
  const double time = line_.timeOf(pulse);
  const ScanPattern::Reading reading = pattern_.at(pulse);
  const Pose true_pose = line_.truePose(time);
  const Eigen::Matrix3d true_rotation =
      groundFromBody(true_pose.roll, true_pose.pitch, true_pose.heading);
  Shot shot;
  shot.true_origin = instrument_.true_system.firingPoint(true_pose.position, true_rotation);
  shot.true_direction = instrument_.true_system.direction(true_rotation, reading.angle);
  const std::vector<Echo>& echoes = tracer_.trace(shot.true_origin, shot.true_direction);
  if (echoes.empty()) return;

  Random random(keyOf({options_.seed, 0x9015E, line_.plan().id, pulse}));
  const bool exact = !options_.noise.trajectory();
  const Pose pose = exact ? true_pose : line_.writtenPose(time);
  const Eigen::Matrix3d rotation =
      exact ? true_rotation : groundFromBody(pose.roll, pose.pitch, pose.heading);
  double angle = reading.angle;
  if (options_.noise.scan_angle > 0.0) angle += options_.noise.scan_angle * random.normal();
  shot.unbiased_origin = instrument_.true_system.firingPoint(pose.position, rotation);
  shot.unbiased_direction = instrument_.true_system.direction(rotation, angle);
  shot.assumed_origin = instrument_.assumed_system.firingPoint(pose.position, rotation);
  shot.assumed_direction = instrument_.assumed_system.direction(rotation, angle);

  const Eigen::Vector3d& beam = shot.assumed_direction;
  const double to_right = beam.x() * std::cos(pose.heading) - beam.y() * std::sin(pose.heading);
  SimulatedPoint point;
  point.time = time;
  point.scan_angle = static_cast<float>(std::atan2(to_right, -beam.z()) / kRadiansPerDegree);
  point.strip = line_.plan().id;
  point.number_of_returns = static_cast<std::uint8_t>(echoes.size());
  point.flags = static_cast<std::uint8_t>((reading.to_right ? kScanDirectionBit : 0) |
                                          (reading.last ? kEdgeBit : 0));
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    point.return_number = static_cast<std::uint8_t>(i + 1);
    record(shot, echoes[i], random, point);
    points.push_back(point);
  }
}

void PulseRun::record(const Shot& shot, const Echo& echo, Random& random,
                      SimulatedPoint& point) const {
  const NoiseOptions& noise = options_.noise;
  double measured = instrument_.true_system.measuredRange(echo.range);
  if (noise.range > 0.0) {
    const double timing = noise.footprint ? kSpreadNoise * echo.spread : 0.0;
    measured += std::hypot(noise.range, timing) * random.normal();
  }
  point.surface = options_.origin + shot.true_origin + echo.range * shot.true_direction;
  point.unbiased = options_.origin + shot.unbiased_origin +
                   instrument_.true_system.distance(measured) * shot.unbiased_direction;
  point.position = options_.origin + shot.assumed_origin +
                   instrument_.assumed_system.distance(measured) * shot.assumed_direction;
  double number = digitalNumber(options_.scanner.gain * line_.plan().gain, echo.signal, echo.range,
                                instrument_.extinction, options_.scanner.range_exponent);
  if (noise.intensity > 0.0) number *= 1.0 + noise.intensity * random.normal();
  point.intensity = static_cast<std::uint16_t>(std::clamp(std::round(number), 0.0, 65535.0));
  point.reflectance = static_cast<float>(echo.reflectance);
  point.classification = asprsClassOf(echo.cover);
}

}  // namespace

struct Simulator::State {
  explicit State(const SimulationOptions& given)
      : options(given), scene(makeScene(options)), instrument(options), lines(fly(options)) {}
  const FlownLine& line(std::size_t strip) const {
    if (strip < lines.size()) return lines[strip];
    throw UsageError("simulation: there is no strip " + std::to_string(strip));
  }

  SimulationOptions options;
  Scene scene;
  Instrument instrument;
  std::vector<FlownLine> lines;
};

Simulator::Simulator(const SimulationOptions& options)
    : state_(std::make_unique<const State>(options)) {}
Simulator::~Simulator() = default;

const SimulationOptions& Simulator::options() const {
  return state_->options;
}
const Scene& Simulator::scene() const {
  return state_->scene;
}
std::size_t Simulator::stripCount() const {
  return state_->lines.size();
}
std::uint64_t Simulator::pulseCount(std::size_t strip) const {
  return state_->line(strip).pulseCount();
}

void Simulator::simulateStrip(std::size_t strip, int threads, const Sink& sink) const {
  const FlownLine& line = state_->line(strip);
  const std::uint64_t pulses = line.pulseCount();
  const std::uint64_t chunks = (pulses + kChunkPulses - 1) / kChunkPulses;
  // Chunks are fixed and a pulse depends on its number alone: threads change nothing but the time.
  const std::uint64_t at_once = 4 * threadCount(threads);
  std::vector<std::vector<SimulatedPoint>> buffers(std::min(at_once, chunks));
  for (std::uint64_t first = 0; first < chunks; first += at_once) {
    const std::uint64_t count = std::min(at_once, chunks - first);
    parallelFor(count, threads, [&](std::size_t i) {
      PulseRun run(state_->options, state_->instrument, state_->scene, line);
      const std::uint64_t begin = (first + i) * kChunkPulses;
      buffers[i].clear();
      for (std::uint64_t pulse = begin; pulse < std::min(pulses, begin + kChunkPulses); ++pulse)
        run.fire(pulse, buffers[i]);
    });
    for (std::uint64_t i = 0; i < count; ++i) sink(buffers[i]);
  }
}

std::vector<SimulatedPoint> Simulator::strip(std::size_t strip, int threads) const {
  std::vector<SimulatedPoint> all;
  simulateStrip(strip, threads, [&all](const std::vector<SimulatedPoint>& points) {
    all.insert(all.end(), points.begin(), points.end());
  });
  return all;
}

std::vector<TrajectorySample> Simulator::trajectory() const {
  std::vector<TrajectorySample> samples;
  for (const FlownLine& line : state_->lines) line.append(state_->options.origin, true, samples);
  return samples;
}

std::vector<TrajectorySample> Simulator::trueTrajectory() const {
  std::vector<TrajectorySample> samples;
  for (const FlownLine& line : state_->lines) line.append(state_->options.origin, false, samples);
  return samples;
}

std::vector<ControlPoint> Simulator::controlPoints() const {
  return chooseControlPoints(state_->scene, state_->options);
}

std::vector<LandCoverSite> Simulator::landCoverSites(int per_class, int set) const {
  return chooseSites(state_->scene, state_->options, per_class, set);
}

}  // namespace pcl_als::simulation
