// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "waveform_run.h"

#include <cmath>
#include <utility>

namespace pcl_als::simulation {

namespace {

constexpr double kPicoseconds = 1000.0;  ///< per nanosecond
constexpr double kNothing = 1e-12;       ///< digital number

}  // namespace

WaveformRun::WaveformRun(PulseRun run, const Scene& scene, const WaveformReceiver& receiver,
                         bool truth)
    : run_(std::move(run)),
      tracer_(scene, run_.options().scanner, receiver.options().rings),
      receiver_(receiver),
      detector_(receiver_, run_.options().scanner.return_separation,
                run_.options().scanner.max_returns),
      truth_(truth) {}

void WaveformRun::receive(const std::vector<Backscatter>& parts, double energy) {
  power_.clear();
  for (const Backscatter& part : parts)
    power_.push_back(
        {2.0 * part.range / kLightSpeed, energy * run_.numberOf(part.signal, part.range)});
}

/// The surfaces that make up a peak of the waveform: those within half a pulse of it, weighted by
/// what they contribute to it, or else the nearest one.
Echo WaveformRun::surfacesAt(const std::vector<Backscatter>& parts, double time) const {
  const double reach = 0.5 * receiver_.pulse().width();
  Echo sum;
  std::size_t nearest = 0;
  bool any = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double distance = std::abs(power_[i].time - time);
    if (distance < std::abs(power_[nearest].time - time)) nearest = i;
    if (distance > reach || power_[i].number < kNothing) continue;
    sum = any ? joinedEchoes(sum, echoOf(parts[i])) : echoOf(parts[i]);
    any = true;
  }
  return any ? sum : echoOf(parts[nearest]);
}

/// The points of the returns that were detected in the waveform of a pulse.
void WaveformRun::addReturns(const ScanPattern::Reading& reading, const Shot& shot,
                             const std::vector<Backscatter>& parts,
                             const std::vector<DetectedReturn>& returns, double first_sample,
                             double timing, SimulatedWaveforms& out) const {
  SimulatedPoint point = run_.startPoint(reading, shot);
  point.return_number = 0;
  point.number_of_returns = static_cast<std::uint8_t>(returns.size());
  for (const DetectedReturn& found : returns) {
    ++point.return_number;
    const Echo echo = surfacesAt(parts, first_sample + found.peak_time);
    const double range = 0.5 * kLightSpeed * (first_sample + found.time);
    run_.place(shot, echo, range - echo.range + timing, found.height / receiver_.countsPerNumber(),
               point);
    const double error = run_.withDetectionError(0.0, shot, echo, point.intensity);
    out.points.push_back(point);
    out.locations.push_back(
        static_cast<float>(kPicoseconds * (found.time + 2.0 * error / kLightSpeed)));
  }
}

void WaveformRun::fire(std::uint64_t pulse, SimulatedWaveforms& out) {
  const ScanPattern::Reading reading = run_.line().pattern().at(pulse);
  Shot shot = run_.aim(reading);
  const std::vector<Backscatter>& parts = tracer_.trace(shot.true_origin, shot.true_direction);
  if (parts.empty()) return;

  Random random = run_.randomOf(pulse);
  run_.report(reading, random, shot);
  const NoiseOptions& noise = run_.options().noise;
  const double timing = noise.range > 0.0 ? noise.range * random.normal() : 0.0;
  receive(parts, noise.intensity > 0.0 ? 1.0 + noise.intensity * random.normal() : 1.0);

  SimulatedPulse entry;
  entry.number = pulse;
  entry.count = out.counts.size();
  entry.first_sample = receiver_.record(power_, random, out.counts);
  entry.counts = out.counts.size() - entry.count;
  const auto& returns = detector_.detect(&out.counts[entry.count], entry.counts);
  if (returns.empty()) {
    out.counts.resize(entry.count);
    return;
  }
  entry.to_sensor = -shot.assumed_direction;
  entry.true_origin = shot.true_origin;
  entry.true_direction = shot.true_direction;
  entry.point = out.points.size();
  entry.points = returns.size();
  addReturns(reading, shot, parts, returns, entry.first_sample, timing, out);
  if (truth_) {
    entry.part = out.backscatter.size();
    entry.parts = parts.size();
    out.backscatter.insert(out.backscatter.end(), parts.begin(), parts.end());
  }
  out.pulses.push_back(entry);
}

}  // namespace pcl_als::simulation
