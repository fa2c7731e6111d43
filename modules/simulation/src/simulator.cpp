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
constexpr double kLeastClearance = 20.0;  ///< metres between the highest ground and a line
constexpr double kDay = 86400.0;          ///< seconds between sessions
/// Share of an echo's spread in range that appears as timing noise.
constexpr double kSpreadNoise = 0.1;

// Bits of PointFlag (common/point_types.h), whose header would bring in PCL.
constexpr std::uint8_t kScanDirectionBit = 16, kEdgeBit = 32;

Scene makeScene(const SimulationOptions& options) {
  options.check();
  const auto [lower, upper] = sceneRectangle(options);
  Scene scene(lower, upper, options.scene, options.seed);
  for (const PlannedLine& line : options.lines) {
    if (line.height < scene.terrain().highest() + kLeastClearance)
      throw UsageError("simulation: line " + std::to_string(line.id) +
                       " is flown into the terrain: more height or less relief is needed");
  }
  if (options.targets == 0) return scene;
  return {lower, upper, options.scene, options.seed, chooseTargets(scene, options)};
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
    if (lines.size() < options.lines.size())
      time += kDay * (options.lines[lines.size()].session - plan.session);
  }
  return lines;
}

/// One channel of the scanner in one strip.
struct Channel {
  Channel(const SimulationOptions& options, const PlannedLine& line, int number)
      : errors(options.errors.of(line.session, line.id, number)),
        true_system(options.mounting, options.scanner.laserFromChannel(number)),
        assumed_system(options.mounting + options.bias + errors.system,
                       options.scanner.laserFromChannel(number)) {}

  double error(ErrorSource source) const { return errors.of(source); }
  /// The angles that the encoder reports, without noise.
  BeamAngles reported(const ScanPattern::Reading& reading) const;

  ErrorValues errors;
  LidarSystem true_system, assumed_system;
};

BeamAngles Channel::reported(const ScanPattern::Reading& reading) const {
  BeamAngles beam = reading.beam;
  const double deflection = error(ErrorSource::deflection_scale);
  if (deflection != 0.0) beam = deflectedMore(beam, 1.0 + deflection);
  const double b = beam.across, torsion = error(ErrorSource::mirror_torsion);
  beam.across +=
      (reading.to_right ? torsion : -torsion) +
      b * b * (error(ErrorSource::encoder_quadratic) + b * error(ErrorSource::encoder_cubic)) +
      error(ErrorSource::encoder_sine) * std::sin(36.0 * b);  // a period of 10 degrees
  return beam;
}

/// Error of the refractive index in a session.
double refractionOf(const SimulationOptions& options, int session) {
  Random random(keyOf({options.seed, 0xA1F, static_cast<std::uint64_t>(session)}));
  return options.noise.refraction * random.normal();
}

/// Fires the pulses of one chunk.
class PulseRun {
 public:
  PulseRun(const SimulationOptions& options, double extinction, const Scene& scene,
           const FlownLine& line)
      : options_(options),
        extinction_(extinction),
        line_(line),
        refraction_(refractionOf(options, line.plan().session)),
        tracer_(scene, options.scanner, options.noise.footprint) {
    for (int i = 0; i < options.scanner.channels; ++i)
      channels_.emplace_back(options, line.plan(), i);
  }

  void fire(std::uint64_t pulse, std::vector<SimulatedPoint>& points);

 private:
  struct Shot;
  Shot aim(const ScanPattern::Reading& reading) const;
  void report(const ScanPattern::Reading& reading, Random& random, Shot& shot) const;
  void record(const Shot& shot, const Echo& echo, Random& random, SimulatedPoint& point) const;
  double rangeError(const Shot& shot, const Echo& echo, double intensity) const;
  /// As GNSS/INS sees it, without the systematic shift of the trajectory.
  Pose poseAt(double time) const {
    return options_.noise.trajectory() ? line_.noisyPose(time) : line_.truePose(time);
  }

  const SimulationOptions& options_;
  double extinction_;
  const FlownLine& line_;
  double refraction_;  ///< error of all ranges, relative
  std::vector<Channel> channels_;
  PulseTracer tracer_;
};

/// A pulse as it was fired, and as position, attitude and encoder report it.
struct PulseRun::Shot {
  const Channel& channel;
  double time;  ///< true
  Eigen::Vector3d true_origin, true_direction;
  Eigen::Vector3d unbiased_origin, unbiased_direction;  ///< reported, with the true parameters
  Eigen::Vector3d assumed_origin, assumed_direction;
  double assumed_heading;
};

PulseRun::Shot PulseRun::aim(const ScanPattern::Reading& reading) const {
  Shot shot{channels_[static_cast<std::size_t>(reading.channel)],
            line_.firstPulseTime() + reading.time,
            {},
            {},
            {},
            {},
            {},
            {},
            0.0};
  const Pose pose = line_.truePose(shot.time);
  const Eigen::Matrix3d rotation = groundFromBody(pose.roll, pose.pitch, pose.heading);
  shot.true_origin = shot.channel.true_system.firingPoint(pose.position, rotation);
  shot.true_direction = shot.channel.true_system.direction(rotation, reading.beam);
  return shot;
}

void PulseRun::report(const ScanPattern::Reading& reading, Random& random, Shot& shot) const {
  const Channel& channel = shot.channel;
  BeamAngles beam = reading.beam, assumed = channel.reported(reading);
  if (options_.noise.scan_angle > 0.0) {
    const double noise = options_.noise.scan_angle * random.normal();
    beam.across += noise;
    assumed.across += noise;
  }
  const Pose pose = poseAt(shot.time);
  const Eigen::Matrix3d rotation = groundFromBody(pose.roll, pose.pitch, pose.heading);
  shot.unbiased_origin = channel.true_system.firingPoint(pose.position, rotation);
  shot.unbiased_direction = channel.true_system.direction(rotation, beam);
  const double tag = shot.time + channel.error(ErrorSource::time_offset);
  const Pose written = tag == shot.time ? pose : poseAt(tag);
  const Eigen::Matrix3d turned =
      tag == shot.time ? rotation : groundFromBody(written.roll, written.pitch, written.heading);
  shot.assumed_origin =
      channel.assumed_system.firingPoint(written.position + line_.shiftAt(tag), turned);
  shot.assumed_direction = channel.assumed_system.direction(turned, assumed);
  shot.assumed_heading = written.heading;
}

void PulseRun::fire(std::uint64_t pulse, std::vector<SimulatedPoint>& points) {
  const ScanPattern::Reading reading = line_.pattern().at(pulse);
  Shot shot = aim(reading);
  const std::vector<Echo>& echoes = tracer_.trace(shot.true_origin, shot.true_direction);
  if (echoes.empty()) return;

  Random random(keyOf({options_.seed, 0x9015E, line_.plan().id, pulse}));
  report(reading, random, shot);
  const Eigen::Vector3d& beam = shot.assumed_direction;
  const double to_right =
      beam.x() * std::cos(shot.assumed_heading) - beam.y() * std::sin(shot.assumed_heading);
  SimulatedPoint point;
  point.time = shot.time + shot.channel.error(ErrorSource::time_offset);
  point.scan_angle = static_cast<float>(std::atan2(to_right, -beam.z()) / kRadiansPerDegree);
  point.strip = line_.plan().id;
  point.channel = static_cast<std::uint8_t>(reading.channel);
  point.number_of_returns = static_cast<std::uint8_t>(echoes.size());
  point.flags = static_cast<std::uint8_t>((reading.to_right ? kScanDirectionBit : 0) |
                                          (reading.last ? kEdgeBit : 0));
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    point.return_number = static_cast<std::uint8_t>(i + 1);
    record(shot, echoes[i], random, point);
    points.push_back(point);
  }
}

double PulseRun::rangeError(const Shot& shot, const Echo& echo, double intensity) const {
  const double range = echo.range, stretch = range * options_.scanner.divergence * echo.tangent;
  return shot.channel.error(ErrorSource::range_scale) * range +
         shot.channel.error(ErrorSource::range_incidence) * stretch +
         shot.channel.error(ErrorSource::range_walk) *
             std::log10(options_.rangeWalkReference() / std::max(1.0, intensity));
}

void PulseRun::record(const Shot& shot, const Echo& echo, Random& random,
                      SimulatedPoint& point) const {
  const NoiseOptions& noise = options_.noise;
  const Channel& channel = shot.channel;
  double measured = channel.true_system.measuredRange(echo.range) + refraction_ * echo.range;
  if (noise.range > 0.0) {
    const double timing = noise.footprint ? kSpreadNoise * echo.spread : 0.0;
    measured += std::hypot(noise.range, timing) * random.normal();
  }
  double number = digitalNumber(options_.scanner.gain * line_.plan().gain, echo.signal, echo.range,
                                extinction_, options_.scanner.range_exponent);
  if (noise.intensity > 0.0) number *= 1.0 + noise.intensity * random.normal();
  point.intensity = static_cast<std::uint16_t>(std::clamp(std::round(number), 0.0, 65535.0));
  point.surface = options_.origin + shot.true_origin + echo.range * shot.true_direction;
  point.unbiased = options_.origin + shot.unbiased_origin +
                   channel.true_system.distance(measured) * shot.unbiased_direction;
  const double assumed =
      channel.assumed_system.distance(measured) + rangeError(shot, echo, point.intensity);
  point.position = options_.origin + shot.assumed_origin + assumed * shot.assumed_direction;
  point.reflectance = static_cast<float>(echo.reflectance);
  point.classification = asprsClassOf(echo.cover);
}

}  // namespace

struct Simulator::State {
  explicit State(const SimulationOptions& given)
      : options(given),
        scene(makeScene(options)),
        extinction(extinctionPerKilometre(options.atmosphere)),
        lines(fly(options)) {}
  const FlownLine& line(std::size_t strip) const {
    if (strip < lines.size()) return lines[strip];
    throw UsageError("simulation: there is no strip " + std::to_string(strip));
  }

  SimulationOptions options;
  Scene scene;
  double extinction;  ///< per kilometre
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
  return state_->line(strip).pattern().pulseCount();
}

void Simulator::simulateStrip(std::size_t strip, int threads, const Sink& sink) const {
  const FlownLine& line = state_->line(strip);
  const std::uint64_t pulses = line.pattern().pulseCount();
  const std::uint64_t chunks = (pulses + kChunkPulses - 1) / kChunkPulses;
  // Chunks are fixed and a pulse depends on its number alone: threads change nothing but the time.
  const std::uint64_t at_once = 4 * threadCount(threads);
  std::vector<std::vector<SimulatedPoint>> buffers(std::min(at_once, chunks));
  for (std::uint64_t first = 0; first < chunks; first += at_once) {
    const std::uint64_t count = std::min(at_once, chunks - first);
    parallelFor(count, threads, [&](std::size_t i) {
      PulseRun run(state_->options, state_->extinction, state_->scene, line);
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
