// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "emitted_pulse.h"
#include "random.h"

namespace pcl_als::simulation {

/// Power that arrives at the receiver at one time.
struct ReceivedPower {
  double time = 0.0;    ///< nanoseconds after the emission
  double number = 0.0;  ///< digital number that it gives (digitalNumber())
};

/** \brief Receiver and digitizer: power to samples.
 *
 * The clock of the digitizer is that of the emission, so that samples are at whole multiples of
 * their spacing. Samples are values of the power, convolved with the emitted pulse, plus baseline
 * and noise, rounded and limited to what the bits hold.
 */
class WaveformReceiver {
 public:
  static constexpr std::size_t kFewestSamples = 64, kMostSamples = 4096;

  explicit WaveformReceiver(const WaveformOptions& options);

  const EmittedPulse& pulse() const { return pulse_; }
  const WaveformOptions& options() const { return options_; }
  /// Digitizer counts of a maximum by the digital number of its echo.
  double countsPerNumber() const { return options_.largestCount() / options_.full_scale; }
  double baseline() const { return options_.baseline * options_.largestCount(); }
  /// Standard deviation of a sample, of noise and rounding, counts.
  double noise() const;

  /** \brief Appends the samples of a pulse.
   *
   * \param power near to far, not empty
   * \param random used by the samples in their order, not at all without noise
   * \return the time of the first sample, nanoseconds after the emission
   * The number of samples is the least of 64, 128, … 4096 that reaches from eight samples before
   * the power to eight samples behind it; more are cut off.
   */
  double record(const std::vector<ReceivedPower>& power, Random& random,
                std::vector<std::uint16_t>& counts);

 private:
  /// Standard deviation of a sample before it is rounded, counts.
  double electronicNoise() const { return options_.noise * options_.largestCount(); }

  WaveformOptions options_;
  EmittedPulse pulse_;
  std::vector<double> voltage_;  ///< counts before the digitizer
};

}  // namespace pcl_als::simulation
