// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_als {

/** \brief A waveform with its echoes, as it is shown to users.
 *
 * Times count from the first sample, in nanoseconds; amplitudes are digitizer counts, and widths
 * are full widths at half maximum.
 */
struct WaveformExample {
  /// Values of the adjusted waveform in the time of a sample.
  static constexpr int kModelValues = 4;

  struct Echo {
    double time = 0.0, time_std = 0.0, amplitude = 0.0, amplitude_std = 0.0, width = 0.0,
           width_std = 0.0;
    bool new_echo = false;  ///< that the scanner did not return
  };

  std::uint64_t number = 0;  ///< of the first point that has it, or of its pulse, from 0
  unsigned descriptor = 0;
  double spacing = 0.0;  ///< of the samples, ns
  double baseline = 0.0, baseline_std = 0.0;
  double noise = 0.0;  ///< standard deviation of a sample
  /// Of a sample that is not saturated or clipped, over the noise.
  double largest_residual = 0.0;
  std::vector<double> samples;
  /// Baseline and echoes, at every spacing / kModelValues from the first to the last sample.
  std::vector<double> model;
  std::vector<Echo> echoes;     ///< in order of time
  std::vector<double> returns;  ///< times of the discrete returns

  /// Sample minus adjusted waveform.
  double residual(std::size_t sample) const {
    return samples[sample] - model[sample * kModelValues];
  }
};

}  // namespace pcl_als
