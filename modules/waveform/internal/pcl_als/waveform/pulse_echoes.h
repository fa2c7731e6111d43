// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include <pcl_als/waveform/echo_settings.h>
#include <pcl_als/waveform/waveform_decomposer.h>
#include <pcl_als/waveform/waveform_reader.h>

namespace pcl_als {

/// An echo in the units of the extra bytes of decomposed files. Without an echo the values are NaN.
struct EchoAttributes {
  float amplitude = std::numeric_limits<float>::quiet_NaN();       ///< digitizer counts
  float echo_width = std::numeric_limits<float>::quiet_NaN();      ///< FWHM, nanoseconds
  float echo_width_std = std::numeric_limits<float>::quiet_NaN();  ///< nanoseconds
  float range_std = std::numeric_limits<float>::quiet_NaN();       ///< metres
  std::uint16_t saturated = 0;                                     ///< samples of the echo
  bool new_echo = false;  ///< that the scanner did not return

  bool hasEcho() const { return amplitude == amplitude; }
};

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

/** \brief The echoes of one pulse after the other, and the returns of the scanner they belong to.
 *
 * A return belongs to the nearest echo within the full width at half maximum of the response; of
 * several candidates the nearest pair is formed first, and a return or an echo belongs to one pair
 * at most. All that decomposes points, in files or in clouds, uses this class. One per thread.
 */
class PulseEchoes {
 public:
  /// \param responses by descriptor index; they and \a settings must exist as long as the object.
  PulseEchoes(const std::map<unsigned, PulseResponse>& responses, const EchoSettings& settings);

  /// Decomposes the waveform of a pulse and pairs its echoes with returns.
  /// \param waveform must exist as long as its example() is asked for
  /// \param locations of the returns, picoseconds from the first sample
  void decompose(const Waveform& waveform, const std::vector<double>& locations);

  const Decomposition& found() const { return found_; }
  int count() const { return found_.count; }
  /// Index of the echo of a return, of the return of an echo; -1: none.
  int echoOf(std::size_t return_index) const { return echo_of_return_[return_index]; }
  int returnOf(int echo) const { return return_of_echo_[static_cast<std::size_t>(echo)]; }
  /// Time of an echo, picoseconds from the first sample.
  double timeOf(int echo) const;
  /// Energy of an echo: amplitude (digitizer counts) times full width at half maximum (ns).
  double energyOf(int echo) const;
  /// The return that is nearest to an echo in time.
  std::size_t nearestReturn(int echo) const;
  /// Intensity of a new echo over that of its nearest return, in proportion to their amplitudes; 0
  /// if no echo belongs to that return.
  double intensityRatio(int echo) const;
  /// \param speed displacement along the pulse, metres per picosecond of the waveform
  EchoAttributes attributesOf(int echo, double speed) const;
  /// The waveform, with a number to call it by.
  WaveformExample example(std::uint64_t number) const;

 private:
  const WaveformEcho& at(int echo) const { return found_.echo[static_cast<std::size_t>(echo)]; }
  WaveformDecomposer& decomposerOf(unsigned index, const WaveformDescriptor& descriptor);
  void match(double reach);
  std::vector<double> model(int per_sample) const;

  const std::map<unsigned, PulseResponse>& responses_;
  const EchoSettings& settings_;
  std::map<unsigned, WaveformDecomposer> decomposers_;
  const PulseResponse* response_ = nullptr;  ///< of the waveform
  const Waveform* waveform_ = nullptr;       ///< that was decomposed last
  Decomposition found_;
  double spacing_ = 0.0;  ///< picoseconds
  std::vector<double> locations_;
  std::vector<int> echo_of_return_, return_of_echo_;
};

/// Return numbers 1, 2, … of points of one pulse, in the order of their times.
std::vector<unsigned> numbersByTime(const std::vector<double>& times);

/// Whether two points have one waveform.
inline bool sameWaveform(const WaveformReference& a, const WaveformReference& b) {
  return a.descriptor != 0 && a.descriptor == b.descriptor && a.byte_offset == b.byte_offset;
}

/// Points of one pulse at most; points that all refer to one packet are divided here.
inline constexpr std::size_t kMostPointsOfPulse = 64;

/// Remembers the packets that were met: the last one of every 2^20 hash values.
class PacketMemory {
 public:
  PacketMemory();
  /// Whether the packet was met before; it is from now on.
  bool meets(std::uint64_t offset);

 private:
  std::vector<std::uint64_t> last_;
};

}  // namespace pcl_als
