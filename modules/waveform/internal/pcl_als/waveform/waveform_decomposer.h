// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include <pcl_als/waveform/pulse_response.h>

namespace pcl_als {

/// Echoes that are looked for in one waveform at most.
inline constexpr int kMostEchoes = 16;

/// One echo of a waveform. Times and widths are in samples, the first sample has the time 0.
struct WaveformEcho {
  double amplitude = 0.0;  ///< largest value above the baseline, digitizer counts
  double time = 0.0;       ///< samples
  double width = 0.0;      ///< PulseResponse::width() of the echo, samples; FWHM / 2.3548
  double amplitude_std = 0.0, time_std = 0.0, width_std = 0.0;
  int saturated = 0;  ///< saturated samples within half a full width at half maximum
};

struct DecompositionSettings {
  /// Samples at least this large are saturated, those at most this small are clipped. By default
  /// none is.
  double saturation = 1e300, clipping = -1e300;
  /// Expected number of false echoes in a waveform of noise or of single echoes, about.
  double false_echoes = 3e-4;
  /// Ringing of the receiver behind a strong echo, relative to its amplitude: smaller echoes within
  /// ringing_reach samples behind it are not accepted. Only for ringing that the response lacks.
  double ringing = 0.0, ringing_reach = 0.0;
  /// Standard deviation of the widths of echoes relative to the width of the response, as prior for
  /// echoes that overlap others so that the data do not determine their widths better.
  double width_spread = 0.1;
  int most_echoes = kMostEchoes;  ///< 1 … kMostEchoes
};

struct Decomposition {
  int count = 0;
  std::array<WaveformEcho, kMostEchoes> echo;  ///< the first \a count, in order of time
  double baseline = 0.0, baseline_std = 0.0;   ///< digitizer counts
  double noise = 0.0;  ///< standard deviation of a sample, from the residuals; digitizer counts
  int saturated = 0;   ///< saturated samples of the waveform
  int clipped = 0;     ///< clipped samples of the waveform
  int iterations = 0;  ///< of all adjustments together
};

/** \brief Decomposes waveforms into echoes: a sum of responses with amplitudes, times and widths on
 * a constant baseline, by maximum likelihood.
 *
 * The number of echoes is the one with the least penalised likelihood, with the noise estimated
 * from each waveform. Saturated and clipped samples are lower and upper bounds. Standard deviations
 * are those of the adjustment with the noise of the waveform.
 *
 * A decomposer has memory of its own: one per thread. Nothing is allocated after the first waveform
 * of a size.
 * \code
 * WaveformDecomposer decomposer(PulseResponse::gaussian(1.8), settings);
 * Decomposition found;
 * decomposer.decompose(counts.data(), counts.size(), found);
 * \endcode
 */
class WaveformDecomposer {
 public:
  /// UsageError for settings outside their ranges.
  explicit WaveformDecomposer(PulseResponse response, const DecompositionSettings& settings = {});
  ~WaveformDecomposer();
  WaveformDecomposer(WaveformDecomposer&&) noexcept;
  WaveformDecomposer& operator=(WaveformDecomposer&&) = delete;

  const PulseResponse& response() const;
  /// Fewer samples than six, or samples that are all equal, have no echoes.
  void decompose(const double* counts, std::size_t samples, Decomposition& result);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
