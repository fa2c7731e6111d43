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

/// Settings of the backscatter cross sections of echoes by the radar equation (Wagner 2010).
struct CrossSectionSettings {
  std::shared_ptr<const Trajectory> trajectory;  ///< for the ranges; null: no cross sections
  std::optional<int> gps_week;  ///< of times that are seconds of the week; default: from the data
  /// Beam divergence, extinction, and the calibration constant if there are no targets.
  CrossSectionModel model;
  /// Level surfaces of known reflectance, from which the calibration constant is estimated.
  std::vector<ReferenceTarget> targets;
  double target_radius = 1.0;  ///< metres; points within this distance belong to a target
  /// Divide the cross section of an echo by the share of the pulse that earlier echoes of the pulse
  /// leave (pulseTransmissions()). The median coefficient of single echoes is taken for a surface
  /// that intercepts the whole pulse.
  bool correct_attenuation = false;
  bool force = false;  ///< continue with a trajectory that cannot belong to the points
};

/// Calibration of the cross sections.
struct CrossSectionResult {
  static constexpr double kLeastTransmission = 0.1;  ///< smallest divisor for the attenuation

  double constant = 1.0;                     ///< calibration constant of CrossSectionModel
  bool calibrated = false;                   ///< false: cross sections are relative
  std::optional<ReferenceResult> reference;  ///< if there are targets
  double full_coefficient = 0.0;  ///< backscatter coefficient of a whole pulse; 0: no correction
};

/// Origin of the times of the echoes of a PulseWaves file.
enum class RangeOrigin {
  automatic,  ///< emitted, if the file states when the emitted samples begin; else anchor
  anchor,     ///< the anchor of the pulse
  emitted     ///< the maximum of the emitted waveform of the pulse
};

/// EchoSettings, and settings of the output.
struct WaveformSettings : EchoSettings {
  CrossSectionSettings cross_sections;
  bool new_echoes = true;     ///< write points for echoes without a return
  bool move_returns = false;  ///< move returns along their pulse to the time of their echo
  RangeOrigin range_from = RangeOrigin::automatic;  ///< for PulseWaves files
  /// Whether the result has examples of waveforms: \a shown, or a choice (WaveformExamples).
  bool examples = false;
  std::vector<std::uint64_t> shown;  ///< indices of points, or of pulses of a PulseWaves file
  int threads = 0;                   ///< 0: all cores; the result does not depend on it

  /// UsageError if a waveform that is to be shown does not exist among \a count points or pulses.
  void checkShown(std::uint64_t count, const std::string& file, const char* what) const;
};

/// Counts of a decomposed file.
struct WaveformCounts {
  std::uint64_t pulses = 0;            ///< of a PulseWaves file
  std::uint64_t points = 0;            ///< of a file of points
  std::uint64_t without_waveform = 0;  ///< points or pulses without a waveform
  std::uint64_t waveforms = 0;
  std::uint64_t echoes = 0;
  std::uint64_t matched = 0;     ///< points with an echo
  std::uint64_t unmatched = 0;   ///< points with a waveform, but without an echo
  std::uint64_t added = 0;       ///< echoes without a point
  std::uint64_t saturated = 0;   ///< waveforms with saturated samples
  std::uint64_t single = 0;      ///< waveforms with one echo
  double sum_offset_ps = 0.0;    ///< sum of the times of echoes behind their points, picoseconds
  std::uint64_t uncovered = 0;   ///< waveforms that the trajectory does not cover
  std::uint64_t attenuated = 0;  ///< echoes whose cross section was divided by a transmission
  std::uint64_t opaque = 0;      ///< echoes among them with the smallest transmission

  void merge(const WaveformCounts& other);
  /// Mean time of echoes behind their points, picoseconds.
  double meanOffset() const {
    return matched > 0 ? sum_offset_ps / static_cast<double>(matched) : 0.0;
  }
};

/// The system response that was used for the waveforms of a descriptor.
struct UsedPulse {
  unsigned descriptor = 0;
  double width_ns = 0.0;  ///< full width at half maximum
  std::string origin;     ///< shape and origin of the response, as text
};

/// Result of decomposeWaveforms().
struct WaveformResult {
  WaveformCounts counts;
  std::vector<UsedPulse> pulses;
  /// Samples of the response of the descriptor with the most waveforms. Times count from its
  /// maximum, which is the time of an echo.
  std::vector<double> pulse;
  double pulse_spacing_ns = 0.0, pulse_first_ns = 0.0;  ///< spacing; time of the first sample
  std::optional<CrossSectionResult> cross_sections;
  std::vector<WaveformExample> examples;
  std::vector<std::string> remarks;
};

/** \brief Decomposes the waveforms of a LAS, LAZ or PulseWaves file into echoes, and writes them as
 * points.
 *
 * The method is described on the page of module waveform.
 *
 * Every point keeps its record. The extra bytes amplitude (digitizer counts), echo_width and
 * echo_width_std (full width at half maximum, nanoseconds), range_std (metres),
 * number_of_samples_saturated and new_echo are appended, and with a trajectory cross_section and
 * backscatter_coefficient (CrossSectionModel). They are NaN for points without an echo. Returns and
 * echoes are paired by PulseEchoes. Points for echoes without a return follow the points of their
 * pulse. They have the record of the nearest return of the pulse with the position and the return
 * point waveform location of the echo, are flagged as synthetic, and have new_echo 1 and class 1.
 * If echoes are added and all returns of the pulse refer to one waveform, the returns are
 * renumbered as far as the point format can store the numbers.
 *
 * Points that refer to one waveform must follow each other. If the same packet is found again after
 * fewer than a million other waveforms, its echoes are not added a second time. Memory is constant.
 * The output appears only when it is complete; external waveforms are copied (WaveformCopy).
 *
 * A PulseWaves file (.pls, with its .wvs) has pulses and no returns. Every echo is a new point, in
 * LAS 1.4 and point format 6, with the CRS of the file and the time, scan flags and source of the
 * pulse (0 for sources above 65535); its scanner is the scanner channel. All points are flagged as
 * synthetic, with new_echo 1 and class 1; return numbers count the echoes of a pulse. The intensity
 * is the amplitude as a share of the largest count, scaled to 16 bits, and the extra byte channel
 * is that of the receiver. A point lies at anchor + (t - e) (target - anchor) / 1000 with the time
 * t of the echo from the anchor in sampling units. Depending on RangeOrigin, e is 0 or the time of
 * the maximum of the emitted pulse, reduced by its mean in the file if the begin of the emitted
 * samples is not stated. If no response is given and the file has emitted pulses, the response is
 * their mean (EmittedPulseMean).
 *
 * UsageError for settings out of their ranges, if the output is the input, for cross sections,
 * moved returns or \a new_echoes false with a PulseWaves file, for a RangeOrigin with other files,
 * and for examples that the file does not have. InputError for files without waveforms, damaged
 * descriptors and packets (WaveformReader, PulseWavesReader), a trajectory that does not belong to
 * the points, if the width of the response cannot be estimated, and if the targets have too few
 * single echoes. Cancelled.
 * \code
 * const auto result = pcl_als::decomposeWaveforms("strip1.las", "echoes.las");
 * std::cout << describe(result);
 * \endcode
 */
WaveformResult decomposeWaveforms(const std::filesystem::path& input,
                                  const std::filesystem::path& output,
                                  const WaveformSettings& settings = {},
                                  const ProgressCallback& progress = {});

/// The counts of a result as a text of a few lines.
std::string describe(const WaveformResult& result);

}  // namespace pcl_als
