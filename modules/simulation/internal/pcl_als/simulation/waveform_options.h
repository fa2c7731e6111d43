// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

namespace pcl_als::simulation {

/** \brief Emitted pulse, receiver, digitizer and detector of a scanner that records waveforms.
 *
 * Levels of the digitizer are shares of its largest count, so that they hold for any number of
 * bits. The emitted pulse contains the response of the receiver.
 */
struct WaveformOptions {
  double pulse_width = 4.0;     ///< full width at half maximum of the pulse, nanoseconds
  double pulse_skewness = 0.0;  ///< third standardised moment; 0: Gaussian
  std::vector<double> pulse;    ///< samples of the pulse in place of width and skewness
  double pulse_spacing = 1.0;   ///< of these samples, nanoseconds

  double sample_spacing = 1.0;  ///< of the digitizer, nanoseconds, a whole number of picoseconds
  int bits = 12;                ///< of a sample, 4 … 16
  double baseline = 0.02;       ///< share of the largest count
  double noise = 0.001;         ///< standard deviation of a sample, share of the largest count
  /// Digital number (intensity) of an echo of the shape of the emitted pulse whose maximum above
  /// the baseline is the largest count; stronger echoes and the baseline saturate earlier.
  double full_scale = 32768.0;

  /// Least height of a peak that the detector of discrete returns finds, in standard deviations of
  /// a sample (noise and rounding).
  double detection_threshold = 8.0;
  /// Share of the height of a peak at which its leading edge is timed.
  double detection_edge = 0.5;
  int rings = 4;  ///< of sub-rays over the footprint; 3 rings² sub-rays

  double largestCount() const {
    return static_cast<double>((1U << static_cast<unsigned>(bits)) - 1U);
  }
  /// UsageError naming the first value that is impossible.
  void check() const;
};

}  // namespace pcl_als::simulation
