// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <pcl_als/las/las_writer.h>
#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/waveform/pulse_echoes.h>
#include <pcl_als/waveform/pulse_waves_reader.h>
#include <pcl_als/waveform/waveform_examples.h>

namespace pcl_als::detail {

/// LAS 1.4, point format 6, with the reference and the times of a Pulse file, steps of a millimetre
/// or less, and the extra bytes of echoes.
LasWriterOptions pointsOfPulses(const PulseWavesFile& pulses);

/// How times of echoes refer to the emitted pulse of their pulse.
struct EmittedTimes {
  PulseResponse response = PulseResponse::gaussian(1.0);  ///< in samples of emitted waveforms
  bool of_stated = false;  ///< they count from it where the begin of its samples is stated
  bool of_others = false;  ///< also where that is not stated, as deviations from \a mean_ns
  double mean_ns = 0.0;    ///< of the maxima of emitted pulses, behind their origin
};

/// What all threads share.
struct PulseJob {
  const WavesFile& waves;
  const WaveformSettings& settings;
  const std::map<unsigned, PulseResponse>& responses;
  const EmittedTimes& emitted;
  const LasWriter& output;  ///< for its layout
};

/** \brief Decomposes the pulses of a Pulse file into records of points; one per thread.
 *
 * Where samplings of several channels overlap, the echoes of one of them are taken: of the first
 * one without saturated samples in the segment, else of the first one.
 */
class PulsePoints {
 public:
  explicit PulsePoints(const PulseJob& job);

  /// Appends the echoes of a pulse as records, in order of time, and counts them.
  void append(const PulseRecord& pulse, std::uint64_t index, std::vector<std::byte>& records,
              WaveformCounts& counts);
  /// Calls \a take with its returning waveforms.
  void takeExamples(const PulseRecord& pulse, std::uint64_t index, const TakeExample& take);

 private:
  struct Echo {
    double units = 0.0;  ///< from the anchor, or from the emitted pulse
    EchoAttributes attributes;
    unsigned channel = 0;
    double largest_count = 0.0;  ///< of the digitizer
  };

  void findEmitted(const PulseDescriptor& descriptor);
  bool isSaturated(const PulseSegment& segment) const;
  void rankSegments();
  bool isTaken(std::size_t segment, double units) const;
  void findEchoes(const PulseRecord& pulse, WaveformCounts& counts);
  void store(const PulseRecord& pulse, std::uint64_t index, std::size_t number,
             std::byte* record) const;

  const PulseJob& job_;
  PulseWavesReader reader_;
  PulseEchoes echoes_;
  WaveformDecomposer emitted_;
  Decomposition emitted_found_;
  double emitted_units_ = 0.0, emitted_std_ = 0.0;  ///< that times count from; sampling units
  std::vector<PulseSegment> segments_;
  std::vector<std::size_t> rank_;  ///< of the segments; 0: not a returning one
  std::vector<Echo> found_;        ///< of the pulse
};

}  // namespace pcl_als::detail
