// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/simulation/radiometry.h>
#include <pcl_als/simulation/simulator.h>

#include "block.h"
#include "flown_line.h"
#include "pulse_run.h"
#include "random.h"
#include "waveform_run.h"

namespace pcl_als::simulation {

namespace {

constexpr std::uint64_t kChunkPulses = 16384;
constexpr std::uint64_t kWaveformChunk = 1024;  ///< pulses
constexpr double kLeastClearance = 20.0;        ///< metres between the highest ground and a line
constexpr double kDay = 86400.0;                ///< seconds between sessions

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

/// Fires the pulses of a line chunk by chunk. Chunks are fixed and a pulse depends on its number
/// alone, so that threads change nothing but the time.
/// \param fire fire(first, end, buffer) fills a buffer with the pulses of a chunk
template <typename Buffer, typename Fire, typename Sink>
void fireInChunks(std::uint64_t pulses, std::uint64_t chunk, int threads, const Fire& fire,
                  const Sink& sink) {
  const std::uint64_t chunks = (pulses + chunk - 1) / chunk;
  const std::uint64_t at_once = 4 * threadCount(threads);
  std::vector<Buffer> buffers(std::min(at_once, chunks));
  for (std::uint64_t first = 0; first < chunks; first += at_once) {
    const std::uint64_t count = std::min(at_once, chunks - first);
    parallelFor(count, threads, [&](std::size_t i) {
      const std::uint64_t begin = (first + i) * chunk;
      buffers[i].clear();
      fire(begin, std::min(pulses, begin + chunk), buffers[i]);
    });
    for (std::uint64_t i = 0; i < count; ++i) sink(buffers[i]);
  }
}

}  // namespace

struct Simulator::State {
  explicit State(const SimulationOptions& given)
      : options(given),
        scene(makeScene(options)),
        extinction(extinctionPerKilometre(options.atmosphere)),
        lines(fly(options)) {
    if (options.waveform) receiver.emplace(*options.waveform);
  }
  const FlownLine& line(std::size_t strip) const {
    if (strip < lines.size()) return lines[strip];
    throw UsageError("simulation: there is no strip " + std::to_string(strip));
  }

  SimulationOptions options;
  Scene scene;
  double extinction;  ///< per kilometre
  std::vector<FlownLine> lines;
  std::optional<WaveformReceiver> receiver;  ///< copied for each thread
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
  const State& s = *state_;
  const FlownLine& line = s.line(strip);
  fireInChunks<std::vector<SimulatedPoint>>(
      line.pattern().pulseCount(), kChunkPulses, threads,
      [&](std::uint64_t pulse, std::uint64_t end, std::vector<SimulatedPoint>& points) {
        DiscreteRun run(s.options, s.extinction, s.scene, line);
        for (; pulse < end; ++pulse) run.fire(pulse, points);
      },
      sink);
}

void Simulator::simulateWaveforms(std::size_t strip, int threads, const WaveformSink& sink,
                                  bool truth) const {
  const State& s = *state_;
  if (!s.receiver) throw UsageError("simulation: the options have no waveforms");
  const FlownLine& line = s.line(strip);
  fireInChunks<SimulatedWaveforms>(
      line.pattern().pulseCount(), kWaveformChunk, threads,
      [&](std::uint64_t pulse, std::uint64_t end, SimulatedWaveforms& waveforms) {
        WaveformRun run(PulseRun(s.options, s.extinction, line), s.scene, *s.receiver, truth);
        for (; pulse < end; ++pulse) run.fire(pulse, waveforms);
      },
      sink);
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
