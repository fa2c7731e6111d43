// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <numeric>

#include <pcl_als/waveform/pulse_echoes.h>

namespace pcl_als {
namespace {

constexpr unsigned kHashBits = 20;

}  // namespace

PulseEchoes::PulseEchoes(const std::map<unsigned, PulseResponse>& responses,
                         const EchoSettings& settings)
    : responses_(responses), settings_(settings) {}

WaveformDecomposer& PulseEchoes::decomposerOf(unsigned index,
                                              const WaveformDescriptor& descriptor) {
  const auto found = decomposers_.find(index);
  if (found != decomposers_.end()) return found->second;
  return decomposers_
      .emplace(index,
               WaveformDecomposer(responses_.at(index), settings_.decompositionOf(descriptor)))
      .first->second;
}

void PulseEchoes::decompose(const Waveform& waveform, const std::vector<double>& locations) {
  spacing_ = waveform.descriptor.spacing_ps;
  locations_ = locations;
  WaveformDecomposer& decomposer = decomposerOf(waveform.reference.descriptor, waveform.descriptor);
  decomposer.decompose(waveform.counts.data(), waveform.counts.size(), found_);
  response_ = &decomposer.response();
  waveform_ = &waveform;
  match(kFwhmOfGaussian * spacing_ * decomposer.response().width());
}

/// Pairs returns and echoes, the nearest first.
void PulseEchoes::match(double reach) {
  echo_of_return_.assign(locations_.size(), -1);
  return_of_echo_.assign(static_cast<std::size_t>(found_.count), -1);
  for (;;) {
    double nearest = reach;
    int best_return = -1, best_echo = -1;
    for (std::size_t r = 0; r < locations_.size(); ++r) {
      if (echo_of_return_[r] >= 0) continue;
      for (int e = 0; e < found_.count; ++e) {
        const double distance = std::abs(timeOf(e) - locations_[r]);
        if (returnOf(e) >= 0 || !(distance < nearest)) continue;
        nearest = distance;
        best_return = static_cast<int>(r);
        best_echo = e;
      }
    }
    if (best_return < 0) return;
    echo_of_return_[static_cast<std::size_t>(best_return)] = best_echo;
    return_of_echo_[static_cast<std::size_t>(best_echo)] = best_return;
  }
}

/// Baseline and echoes at every 1 / \a per_sample from the first to the last sample.
std::vector<double> PulseEchoes::model(int per_sample) const {
  const std::size_t samples = waveform_->counts.size();
  if (samples == 0) return {};
  const auto last = static_cast<int>(samples) - 1;
  std::vector<double> values(static_cast<std::size_t>(last * per_sample + 1), found_.baseline);
  std::vector<double> response(samples), by_time(samples), by_width(samples);
  for (int e = 0; e < found_.count; ++e) {
    for (int part = 0; part < per_sample; ++part) {
      const double time = at(e).time - static_cast<double>(part) / per_sample;
      const int first =
          std::max(0, static_cast<int>(std::ceil(time - response_->before(at(e).width))));
      const int end =
          std::min(last, static_cast<int>(std::floor(time + response_->after(at(e).width)))) + 1;
      if (first >= end) continue;
      response_->evaluate(time, at(e).width, first, end, response.data(), by_time.data(),
                          by_width.data());
      for (int i = first; i < end; ++i) {
        const auto place = static_cast<std::size_t>(i * per_sample + part);
        if (place < values.size())
          values[place] += at(e).amplitude * response[static_cast<std::size_t>(i - first)];
      }
    }
  }
  return values;
}

WaveformExample PulseEchoes::example(std::uint64_t number) const {
  WaveformExample example;
  example.number = number;
  example.descriptor = waveform_->reference.descriptor;
  example.spacing = spacing_ / kPicosecondsPerNanosecond;
  example.baseline = found_.baseline;
  example.baseline_std = found_.baseline_std;
  example.noise = found_.noise;
  example.samples = waveform_->counts;
  example.model = model(WaveformExample::kModelValues);
  const double width = example.spacing * kFwhmOfGaussian;
  for (int e = 0; e < found_.count; ++e) {
    const WaveformEcho& echo = at(e);
    example.echoes.push_back({example.spacing * echo.time, example.spacing * echo.time_std,
                              echo.amplitude, echo.amplitude_std, width * echo.width,
                              width * echo.width_std, returnOf(e) < 0});
  }
  for (const double location : locations_)
    example.returns.push_back(location / kPicosecondsPerNanosecond);
  // Saturated and clipped samples are bounds.
  const DecompositionSettings bounds = settings_.decompositionOf(waveform_->descriptor);
  for (std::size_t i = 0; i < example.samples.size() && found_.noise > 0.0; ++i) {
    if (example.samples[i] >= bounds.saturation || example.samples[i] <= bounds.clipping) continue;
    example.largest_residual =
        std::max(example.largest_residual, std::abs(example.residual(i)) / found_.noise);
  }
  return example;
}

double PulseEchoes::timeOf(int echo) const {
  return at(echo).time * spacing_;
}

double PulseEchoes::energyOf(int echo) const {
  const WaveformEcho& e = at(echo);
  return e.amplitude * e.width * kFwhmOfGaussian * spacing_ / kPicosecondsPerNanosecond;
}

std::size_t PulseEchoes::nearestReturn(int echo) const {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < locations_.size(); ++r) {
    const double distance = std::abs(locations_[r] - timeOf(echo));
    if (!(distance < least)) continue;
    least = distance;
    nearest = r;
  }
  return nearest;
}

double PulseEchoes::intensityRatio(int echo) const {
  const int other = echoOf(nearestReturn(echo));
  return other < 0 ? 0.0 : at(echo).amplitude / at(other).amplitude;
}

EchoAttributes PulseEchoes::attributesOf(int echo, double speed) const {
  const double scale = spacing_ / kPicosecondsPerNanosecond * kFwhmOfGaussian;
  const WaveformEcho& e = at(echo);
  EchoAttributes attributes;
  attributes.amplitude = static_cast<float>(e.amplitude);
  attributes.echo_width = static_cast<float>(scale * e.width);
  attributes.echo_width_std = static_cast<float>(scale * e.width_std);
  attributes.range_std = static_cast<float>(e.time_std * spacing_ * speed);
  attributes.saturated = static_cast<std::uint16_t>(e.saturated);
  attributes.new_echo = returnOf(echo) < 0;
  return attributes;
}

std::vector<unsigned> numbersByTime(const std::vector<double>& times) {
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&times](std::size_t a, std::size_t b) { return times[a] < times[b]; });
  std::vector<unsigned> numbers(times.size());
  for (std::size_t i = 0; i < order.size(); ++i) numbers[order[i]] = static_cast<unsigned>(i + 1);
  return numbers;
}

PacketMemory::PacketMemory() : last_(std::size_t{1} << kHashBits, ~std::uint64_t{0}) {}

bool PacketMemory::meets(std::uint64_t offset) {
  constexpr std::uint64_t kOddFactor = 0x9E3779B97F4A7C15;  // multiplicative hashing
  std::uint64_t& place = last_[(offset * kOddFactor) >> (64 - kHashBits)];
  const bool met = place == offset;
  place = offset;
  return met;
}

}  // namespace pcl_als
