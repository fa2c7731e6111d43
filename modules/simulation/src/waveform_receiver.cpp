// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "waveform_receiver.h"

#include <algorithm>
#include <cmath>

namespace pcl_als::simulation {

namespace {

constexpr double kMarginSamples = 8.0;  ///< of the baseline before and behind the echoes

}  // namespace

WaveformReceiver::WaveformReceiver(const WaveformOptions& options)
    : options_(options), pulse_(options) {}

double WaveformReceiver::noise() const {
  return std::sqrt(electronicNoise() * electronicNoise() + 1.0 / 12.0);
}

double WaveformReceiver::record(const std::vector<ReceivedPower>& power, Random& random,
                                std::vector<std::uint16_t>& counts) {
  const double spacing = options_.sample_spacing;
  const double begin = power.front().time - pulse_.before(),
               end = power.back().time + pulse_.after();
  const double first = std::floor(begin / spacing - kMarginSamples);
  const double wanted = std::ceil(end / spacing + kMarginSamples) - first;
  std::size_t samples = kFewestSamples;
  while (samples < kMostSamples && static_cast<double>(samples) < wanted) samples *= 2;

  voltage_.assign(samples, baseline());
  for (const ReceivedPower& p : power) {
    const double height = p.number * countsPerNumber(), centre = p.time / spacing - first;
    const double from = std::ceil(centre - pulse_.before() / spacing);
    const double to = std::floor(centre + pulse_.after() / spacing);
    const double last = std::min(to, static_cast<double>(samples - 1));
    for (double i = std::max(0.0, from); i <= last; ++i)
      voltage_[static_cast<std::size_t>(i)] += height * pulse_.at((i - centre) * spacing);
  }
  const double noise = electronicNoise(), largest = options_.largestCount();
  for (double value : voltage_) {
    if (noise > 0.0) value += noise * random.normal();
    counts.push_back(static_cast<std::uint16_t>(std::clamp(std::round(value), 0.0, largest)));
  }
  return first * spacing;
}

}  // namespace pcl_als::simulation
