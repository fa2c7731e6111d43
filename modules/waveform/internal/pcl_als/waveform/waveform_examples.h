// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <pcl_als/waveform/pulse_echoes.h>

namespace pcl_als {

/** \brief Chooses among waveforms: two of each number of echoes (none, one, … five and more), by
 * chance, and the two with the largest residuals.
 *
 * The choice depends on the waveforms and their numbers alone, not on their order, as long as no
 * two residuals are equal.
 */
class WaveformExamples {
 public:
  /// Waveforms that are looked at for a choice from a whole file.
  static constexpr std::uint64_t kWaveforms = 4000;

  void offer(const WaveformExample& example);
  /// In order of the number of echoes, those with the largest residuals last.
  std::vector<WaveformExample> chosen() const;

 private:
  static constexpr std::size_t kKinds = 6, kOfEach = 2;
  struct Candidate {
    double order = std::numeric_limits<double>::infinity();  ///< the least ones are chosen
    WaveformExample example;
  };
  using Chosen = std::array<Candidate, kOfEach>;
  static void insert(Chosen& among, double order, const WaveformExample& example);

  std::array<Chosen, kKinds> by_echoes_;
  Chosen by_residual_;
};

using TakeExample = std::function<void(const WaveformExample&)>;

/// The waveforms of the items (points, pulses) that are asked for, or a choice from all of them.
/// \param readOne calls \a take with the waveforms of an item, readRun with those of consecutive
/// ones
std::vector<WaveformExample> waveformExamples(
    std::uint64_t items, const std::vector<std::uint64_t>& asked,
    const std::function<void(std::uint64_t item, const TakeExample& take)>& readOne,
    const std::function<void(std::uint64_t first, std::size_t count, const TakeExample& take)>&
        readRun);

}  // namespace pcl_als
