// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <pcl_als/waveform/pulse_response.h>
#include <pcl_als/waveform/waveform_decomposer.h>
#include <pcl_als/waveform/waveform_descriptor.h>

namespace pcl_als {

struct Waveform;

inline constexpr double kPicosecondsPerNanosecond = 1000.0;

/// Response of the system, and what is accepted as an echo, for waveforms of any spacing.
struct EchoSettings {
  /// Full width at half maximum of the response, a Gaussian, nanoseconds; 0: the response is
  /// estimated from the waveforms (PulseEstimate).
  double pulse_width_ns = 0.0;
  /// Samples of the response in place of a Gaussian, with their spacing in nanoseconds.
  std::vector<double> pulse;
  double pulse_spacing_ns = 0.0;
  double false_echoes = 3e-4;  ///< expected in a waveform, as DecompositionSettings
  double ringing = 0.0;        ///< of the amplitude of the echo before, as DecompositionSettings
  double ringing_reach_ns = 30.0;
  double saturation = 0.0;  ///< digitizer counts; 0: the largest that the bits of a sample can hold

  /// UsageError for values out of their ranges, and for both a width and samples of the response.
  void check() const;
  /// Whether the response is given; otherwise it is estimated.
  bool givesResponse() const { return pulse_width_ns > 0.0 || !pulse.empty(); }
  /// Digitizer count from which samples are saturated.
  double saturationOf(const WaveformDescriptor& descriptor) const {
    return saturation > 0.0 ? saturation : descriptor.largestCount();
  }
  /// The same in samples of one descriptor.
  DecompositionSettings decompositionOf(const WaveformDescriptor& descriptor) const;
};

/// Calls \a take with the waveforms of points first, first + 1, …, first + count - 1.
using WaveformRunReader = std::function<void(std::uint64_t first, std::size_t count,
                                             const std::function<void(const Waveform&)>& take)>;

/// Calls \a visit with the first item and the number of items of up to 40 runs all over \a all
/// items, \a wanted together or somewhat more, or all where there are fewer.
void visitRuns(std::uint64_t all, std::uint64_t wanted,
               const std::function<void(std::uint64_t first, std::size_t count)>& visit);

/// The response that is used, and what is known of it.
struct ResponseChoice {
  std::map<unsigned, PulseResponse> by_descriptor;
  /// By descriptor with enough waveforms; empty if the response was given.
  std::map<unsigned, EstimatedPulse> estimates;
  unsigned usual = 0;  ///< the descriptor of most waveforms that has an estimate
};

/** \brief Responses as given, or estimated from single echoes.
 *
 * The response in nanoseconds of the descriptor with most waveforms serves for descriptors with too
 * few of them.
 * \param points number of points
 * \param read reads runs of them all over the survey, if the response is not given
 * \param name of the file, for messages
 * InputError "NAME: …" if the width cannot be estimated.
 */
ResponseChoice pulseResponses(const std::map<unsigned, WaveformDescriptor>& descriptors,
                              const EchoSettings& settings, std::uint64_t points,
                              const WaveformRunReader& read, const std::string& name);

}  // namespace pcl_als
