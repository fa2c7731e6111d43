// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <map>
#include <optional>
#include <vector>

#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/waveform/pulse_echoes.h>
#include <pcl_als/waveform/waveform_reader.h>

#include "echo_cross_sections.h"
#include "waveform_pulses.h"

namespace pcl_als::detail {

/// The extra bytes of an echo, in the order in which storeEchoAttributes() expects them.
std::vector<LasExtraField> echoAttributeFields();
/// \param fields those of echoAttributeFields() with their positions, and perhaps others behind
/// them
void storeEchoAttributes(const EchoAttributes& echo, const std::vector<LasExtraField>& fields,
                         std::byte* record);

/// The extra fields of the output, and where they lie in its records.
struct EchoFields {
  std::vector<LasExtraField> fields;  ///< placed
  std::size_t record_length = 0;      ///< of the output

  /// \param cross_sections null: without them
  EchoFields(const LasFile& las, const EchoCrossSections* cross_sections);
  void store(const EchoAttributes& echo, std::byte* record) const;
  /// NaN: unknown. Nothing without cross sections.
  void storeSection(float cross_section, float coefficient, std::byte* record) const;
};

/// What all threads share.
struct EchoJob {
  const LasFile& las;
  const WaveformSource& source;
  const WaveformSettings& settings;
  std::map<unsigned, PulseResponse> responses;  ///< by descriptor
  EchoFields fields;
  LasScaling metres;                                  ///< of the coordinates
  const EchoCrossSections* cross_sections = nullptr;  ///< null: none are computed
};

/** \brief Decomposes pulses into records of the output; one per thread.
 */
class EchoWriter {
 public:
  explicit EchoWriter(const EchoJob& job);

  std::size_t recordLength() const { return job_.fields.record_length; }
  /// Appends the records of a pulse to \a records, and counts it.
  void append(const WaveformPulse& pulse, std::vector<std::byte>& records, WaveformCounts& counts);
  /// The waveform of a pulse, for users; nothing where there is none.
  /// \param number of the point by which it is called
  std::optional<WaveformExample> example(const WaveformPulse& pulse, std::uint64_t number);

 private:
  std::byte* addRecord(const std::byte* record, std::vector<std::byte>& records);
  void storeEcho(int echo, const WaveformReference& own, std::byte* record) const;
  void moveTo(double time_ps, const WaveformReference& own, std::uint64_t point,
              std::byte* record) const;
  void findSections(const WaveformPulse& pulse, WaveformCounts& counts);
  void addEchoes(const WaveformPulse& pulse, std::vector<std::byte>& records);
  void renumber(const WaveformPulse& pulse, std::size_t begin,
                std::vector<std::byte>& records) const;

  bool findEchoes(const WaveformPulse& pulse);

  const EchoJob& job_;
  WaveformReader reader_;
  PulseEchoes echoes_;
  Waveform waveform_;
  std::vector<double> locations_;  ///< of the returns of the pulse
  PulseSections sections_;
  std::size_t node_ = 0;  ///< on the trajectory
};

}  // namespace pcl_als::detail
