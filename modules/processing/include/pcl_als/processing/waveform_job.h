// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/progress.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/radiometry/cross_section.h>
#include <pcl_als/radiometry/reference_targets.h>
#include <pcl_als/trajectory/trajectory.h>
#include <pcl_als/waveform/echo_settings.h>
#include <pcl_als/waveform/pulse_echoes.h>

namespace pcl_als {

/// Cross sections of echoes by the radar equation.
struct CrossSectionSettings {
  std::shared_ptr<const Trajectory> trajectory;  ///< for the ranges; null: no cross sections
  std::optional<int> gps_week;
  /// Divergence of the beam, extinction, and the calibration constant if there are no targets.
  CrossSectionModel model;
  /// Level surfaces of known reflectance, from which the calibration constant is estimated.
  std::vector<ReferenceTarget> targets;
  double target_radius = 1.0;  ///< metres: points this close belong to a target
  /// Divide echoes behind others of their pulse by the transmission that these leave
  /// (pulseTransmissions()), with the median coefficient of single echoes as that of a whole pulse.
  bool correct_attenuation = false;
  bool force = false;  ///< continue with a trajectory that cannot belong to the points
};

struct CrossSectionResult {
  static constexpr double kLeastTransmission = 0.1;

  double constant = 1.0;                     ///< of CrossSectionModel
  bool calibrated = false;                   ///< otherwise cross sections are relative
  std::optional<ReferenceResult> reference;  ///< if there were targets
  double full_coefficient = 0.0;  ///< backscatter coefficient of a whole pulse; 0: no correction
};

/// Where the times of the echoes of a Pulse file count from.
enum class RangeOrigin {
  automatic,  ///< the emitted pulse where the file states when its samples begin, else the anchor
  anchor,     ///< as the file states them
  emitted     ///< the maximum of the emitted pulse of the same pulse
};

/// EchoSettings, and what is written.
struct WaveformSettings : EchoSettings {
  CrossSectionSettings cross_sections;
  bool new_echoes = true;     ///< write the echoes that no return belongs to
  bool move_returns = false;  ///< move returns along their pulse to the time of their echo
  RangeOrigin range_from = RangeOrigin::automatic;  ///< of Pulse files
  bool examples = false;  ///< waveforms in the result: \a shown, or a choice of WaveformExamples
  std::vector<std::uint64_t> shown;  ///< numbers of points, or of pulses of a Pulse file, from 0
  int threads = 0;                   ///< 0: all cores; the result does not depend on it

  /// UsageError if a waveform that is to be shown does not exist among \a count points or pulses.
  void checkShown(std::uint64_t count, const std::string& file, const char* what) const;
};

/// Counts of a decomposed file.
struct WaveformCounts {
  std::uint64_t pulses = 0;            ///< of a Pulse file
  std::uint64_t points = 0;            ///< of a file of points
  std::uint64_t without_waveform = 0;  ///< points, or pulses
  std::uint64_t waveforms = 0;
  std::uint64_t echoes = 0;
  std::uint64_t matched = 0;     ///< points that an echo belongs to
  std::uint64_t unmatched = 0;   ///< points with a waveform that no echo belongs to
  std::uint64_t added = 0;       ///< echoes that no point belongs to
  std::uint64_t saturated = 0;   ///< waveforms with saturated samples
  std::uint64_t single = 0;      ///< waveforms with one echo
  double sum_offset_ps = 0.0;    ///< of the echoes behind their points, over \a matched
  std::uint64_t uncovered = 0;   ///< waveforms that the trajectory does not cover
  std::uint64_t attenuated = 0;  ///< echoes whose cross section was divided by a transmission
  std::uint64_t opaque = 0;      ///< those of them that had the least transmission

  void merge(const WaveformCounts& other);
  double meanOffset() const {
    return matched > 0 ? sum_offset_ps / static_cast<double>(matched) : 0.0;
  }
};

/// The response that was used for the waveforms of a descriptor.
struct UsedPulse {
  unsigned descriptor = 0;
  double width_ns = 0.0;  ///< full width at half maximum
  std::string origin;     ///< its shape and where it is from, as text
};

struct WaveformResult {
  WaveformCounts counts;
  std::vector<UsedPulse> pulses;
  /// Samples of the response of the descriptor with most waveforms, of any if it was given; the
  /// time 0 is that of the maximum, which is the time of an echo.
  std::vector<double> pulse;
  double pulse_spacing_ns = 0.0, pulse_first_ns = 0.0;  ///< and the time of the first sample
  std::optional<CrossSectionResult> cross_sections;
  std::vector<WaveformExample> examples;
  std::vector<std::string> remarks;
};

/** \brief Decomposes the waveforms of a LAS, LAZ or PulseWaves file into echoes, and writes them as
 * points.
 *
 * Every point keeps its record. The extra bytes amplitude (digitizer counts), echo_width and
 * echo_width_std (full width at half maximum, nanoseconds), range_std (metres),
 * number_of_samples_saturated and new_echo are appended, and with a trajectory cross_section and
 * backscatter_coefficient (CrossSectionModel); without an echo they are NaN. Returns
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
 * A Pulse file (.pls, with its .wvs) has pulses and no returns: every echo is a new point, in LAS
 * 1.4 and point format 6, with the reference, time, scan flags and source of the pulse (0 for
 * sources above 65535), and its scanner as channel. All are flagged as synthetic, with new_echo 1
 * and class 1; return numbers count the echoes of a pulse. The intensity is the amplitude as a
 * share of the largest count, over 16 bits, and the extra byte channel is that of the receiver. A
 * point lies at anchor + (t - e) (target - anchor) / 1000 with the time t of the echo from the
 * anchor in sampling units. By RangeOrigin e is 0, or the time of the maximum of the emitted pulse,
 * less its mean in the file where the begin of its samples is not stated. Without a given response,
 * that of a Pulse file with emitted pulses is their mean (EmittedPulseMean).
 *
 * UsageError for settings out of their ranges, where the output is the input, for cross sections,
 * moved returns or returns alone of a Pulse file, for a RangeOrigin of other files, and for
 * waveforms to be shown that the file does not have. InputError for files without waveforms,
 * damaged descriptors and packets (WaveformReader, PulseWavesReader), and if the width of the
 * response cannot be estimated; also for a trajectory that does not belong to the points, and if
 * the targets have too few single echoes. Cancelled.
 */
WaveformResult decomposeWaveforms(const std::filesystem::path& input,
                                  const std::filesystem::path& output,
                                  const WaveformSettings& settings = {},
                                  const ProgressCallback& progress = {});

/// The counts as text of a few lines.
std::string describe(const WaveformResult& result);

}  // namespace pcl_als
