// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/waveform/pulse_waves_file.h>
#include <pcl_als/waveform/waveform_reader.h>

namespace pcl_als {

/// A part of a waveform that was digitised without interruption.
struct PulseSegment {
  const PulseSampling* sampling = nullptr;
  /// First sample, sampling units of the pulse behind its anchor; of an emitted waveform behind the
  /// origin of the pulse, as the format states.
  double start = 0.0;
  double step = 1.0;  ///< between samples, sampling units of the pulse
  /// Counts as they are stored. The reference has the descriptor PulseSampling::waveform and the
  /// place of the samples; its location is the first sample, its direction that of the pulse.
  Waveform waveform;

  double unitsAt(double sample) const { return start + step * sample; }
  double end() const { return unitsAt(static_cast<double>(waveform.counts.size())); }
};

/// The Waves file (.wvs) beside a Pulse file. Const member functions may be called by several
/// threads.
class WavesFile {
 public:
  /** \param pulses must exist as long as the object.
   *
   * InputError for a missing Waves file, a compressed one (.wvz), and another signature.
   */
  explicit WavesFile(const PulseWavesFile& pulses);
  ~WavesFile();
  WavesFile(const WavesFile&) = delete;
  WavesFile& operator=(const WavesFile&) = delete;

  const PulseWavesFile& pulses() const;
  const std::string& name() const;
  std::uint64_t size() const;
  void read(std::uint64_t position, std::size_t bytes, std::byte* out) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/** \brief Reads the waves of pulses, in any order; fast in the order of the Waves file.
 *
 * A reader has a buffer of its own, so that each thread needs one.
 */
class PulseWavesReader {
 public:
  explicit PulseWavesReader(const WavesFile& waves) : waves_(waves) {}

  /** \brief Reads the segments of a pulse in the order of the file; segments of a sampling that
   * continue each other are joined.
   *
   * \param index of the pulse, for messages
   * \return false if the pulse has no waves
   * InputError "FILE: pulse N: …" for a descriptor that the file lacks, waves that reach past the
   * end of the Waves file, anchor and target that coincide, and segments of the returning waveform
   * that do not begin and end at the first and last returning sample of the pulse.
   */
  bool read(const PulseRecord& pulse, std::uint64_t index, std::vector<PulseSegment>& segments);

 private:
  const std::byte* take(std::size_t bytes);
  std::uint32_t number(unsigned bits);
  double duration(const PulseSampling& sampling);
  void readSampling(const PulseRecord& pulse, const PulseDescriptor& descriptor,
                    const PulseSampling& sampling, std::vector<PulseSegment>& segments);
  void readSegment(PulseSegment& segment, std::uint32_t samples);
  std::string pulseName() const;

  const WavesFile& waves_;
  std::vector<std::byte> buffer_;
  std::uint64_t begin_ = 0, end_ = 0;  ///< of the Waves file in the buffer
  std::uint64_t position_ = 0;         ///< of the next byte
  std::uint64_t index_ = 0;            ///< of the pulse
};

}  // namespace pcl_als
