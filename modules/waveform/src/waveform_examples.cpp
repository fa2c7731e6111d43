// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/waveform/echo_settings.h>
#include <pcl_als/waveform/waveform_examples.h>

namespace pcl_als {
namespace {

/// A number in [0, 1) that looks random, the same for the same number (SplitMix64).
double mixed(std::uint64_t number) {
  std::uint64_t z = number + 0x9E3779B97F4A7C15;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  return std::ldexp(static_cast<double>((z ^ (z >> 31)) >> 11), -53);
}

}  // namespace

void WaveformExamples::insert(Chosen& among, double order, const WaveformExample& example) {
  const auto place = std::find_if(among.begin(), among.end(), [order](const Candidate& candidate) {
    return order < candidate.order;
  });
  if (place == among.end()) return;
  std::move_backward(place, among.end() - 1, among.end());
  *place = {order, example};
}

void WaveformExamples::offer(const WaveformExample& example) {
  insert(by_echoes_[std::min(example.echoes.size(), kKinds - 1)], mixed(example.number), example);
  insert(by_residual_, -example.largest_residual, example);
}

std::vector<WaveformExample> waveformExamples(
    std::uint64_t items, const std::vector<std::uint64_t>& asked,
    const std::function<void(std::uint64_t item, const TakeExample& take)>& readOne,
    const std::function<void(std::uint64_t first, std::size_t count, const TakeExample& take)>&
        readRun) {
  std::vector<WaveformExample> found;
  for (const std::uint64_t item : asked)
    readOne(item, [&found](const WaveformExample& example) { found.push_back(example); });
  if (!asked.empty()) return found;
  WaveformExamples examples;
  visitRuns(items, WaveformExamples::kWaveforms, [&](std::uint64_t first, std::size_t count) {
    readRun(first, count, [&examples](const WaveformExample& example) { examples.offer(example); });
  });
  return examples.chosen();
}

std::vector<WaveformExample> WaveformExamples::chosen() const {
  std::vector<WaveformExample> all;
  const auto add = [&all](const Chosen& chosen) {
    for (const Candidate& candidate : chosen) {
      const bool empty = !std::isfinite(candidate.order);
      const bool there = std::any_of(all.begin(), all.end(), [&](const WaveformExample& other) {
        return other.number == candidate.example.number;
      });
      if (!empty && !there) all.push_back(candidate.example);
    }
  };
  for (const Chosen& chosen : by_echoes_) add(chosen);
  add(by_residual_);
  return all;
}

}  // namespace pcl_als
