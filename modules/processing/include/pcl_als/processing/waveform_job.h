// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/progress.h>
#include <pcl_als/waveform/echo_settings.h>

namespace pcl_als {

/// EchoSettings, and what is written.
struct WaveformSettings : EchoSettings {
  bool new_echoes = true;     ///< write the echoes that no return belongs to
  bool move_returns = false;  ///< move returns along their pulse to the time of their echo
  int threads = 0;            ///< 0: all cores; the result does not depend on it
};

/// Counts of a decomposed file.
struct WaveformCounts {
  std::uint64_t points = 0;            ///< of the input
  std::uint64_t without_waveform = 0;  ///< points
  std::uint64_t waveforms = 0;
  std::uint64_t echoes = 0;
  std::uint64_t matched = 0;    ///< points that an echo belongs to
  std::uint64_t unmatched = 0;  ///< points with a waveform that no echo belongs to
  std::uint64_t added = 0;      ///< echoes that no point belongs to
  std::uint64_t saturated = 0;  ///< waveforms with saturated samples
  std::uint64_t single = 0;     ///< waveforms with one echo
  double sum_offset_ps = 0.0;   ///< of the echoes behind their points, over \a matched

  void merge(const WaveformCounts& other);
  double meanOffset() const {
    return matched > 0 ? sum_offset_ps / static_cast<double>(matched) : 0.0;
  }
};

struct WaveformResult {
  WaveformCounts counts;
  /// Of the response that was used, nanoseconds, by descriptor index.
  std::vector<std::pair<unsigned, double>> pulse_width_ns;
  std::vector<std::string> remarks;
};

/** \brief Decomposes the waveforms of a LAS or LAZ file into echoes, and writes them as points.
 *
 * Every point keeps its record. The extra bytes amplitude (digitizer counts), echo_width and
 * echo_width_std (full width at half maximum, nanoseconds), range_std (metres),
 * number_of_samples_saturated and new_echo are appended; without an echo they are NaN. Returns
 * and echoes are paired by PulseEchoes. Echoes that no return belongs to
 * follow the points of their pulse: the record of the nearest return of the pulse, flagged as
 * synthetic, with new_echo 1, class 1, and with the position and the return point waveform location
 * of the echo. Return numbers are renumbered where echoes are added and all returns of the pulse
 * share one waveform, up to what the point format can store.
 *
 * Points that share a waveform must follow each other for this; where the same packet is met again,
 * no echo is added a second time if fewer than a million waveforms lie between. Memory is constant.
 * Output through AtomicFile, with external waveforms copied (WaveformCopy).
 *
 * UsageError for settings out of their ranges and where the output is the input. InputError for
 * files without waveforms, damaged descriptors and packets (WaveformReader), and if the width of
 * the response cannot be estimated. Cancelled.
 */
WaveformResult decomposeWaveforms(const std::filesystem::path& input,
                                  const std::filesystem::path& output,
                                  const WaveformSettings& settings = {},
                                  const ProgressCallback& progress = {});

/// The counts as text of a few lines.
std::string describe(const WaveformResult& result);

}  // namespace pcl_als
