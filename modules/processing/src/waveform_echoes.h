// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/waveform/waveform_decomposer.h>
#include <pcl_als/waveform/waveform_reader.h>

#include "waveform_pulses.h"

namespace pcl_als::detail {

/// The extra fields of the output, and where they lie in its records.
struct EchoFields {
  std::vector<LasExtraField> fields;  ///< placed
  std::size_t record_length = 0;      ///< of the output

  explicit EchoFields(const LasFile& las);
  /// Values of a point without an echo, or of an echo.
  void storeNothing(std::byte* record) const;
  void store(std::byte* record, const WaveformEcho& echo, double spacing_ns, double range_std,
             bool is_new) const;
};

/// What all threads share.
struct EchoJob {
  const LasFile& las;
  const WaveformSource& source;
  const WaveformSettings& settings;
  std::map<unsigned, PulseResponse> responses;  ///< by descriptor
  EchoFields fields;
  LasScaling metres;  ///< of the coordinates
};

/** \brief Decomposes pulses into records of the output; one per thread.
 */
class EchoWriter {
 public:
  explicit EchoWriter(const EchoJob& job);

  std::size_t recordLength() const { return job_.fields.record_length; }
  /// Appends the records of a pulse to \a records, and counts it.
  void append(const WaveformPulse& pulse, std::vector<std::byte>& records, WaveformCounts& counts);

 private:
  struct Match {
    std::vector<int> echo_of_point;  ///< -1: none
    std::vector<int> point_of_echo;
  };

  WaveformDecomposer& decomposerOf(unsigned descriptor);
  void match(const WaveformPulse& pulse);
  std::byte* addRecord(const std::byte* record, std::vector<std::byte>& records);
  void storeEcho(int echo, const WaveformReference& own, bool is_new, std::byte* record) const;
  void moveTo(double time_ps, const WaveformReference& own, std::uint64_t point,
              std::byte* record) const;
  void addEchoes(const WaveformPulse& pulse, std::vector<std::byte>& records);
  int nearestPoint(const WaveformPulse& pulse, double time_ps) const;
  void renumber(const WaveformPulse& pulse, std::size_t begin,
                std::vector<std::byte>& records) const;

  const EchoJob& job_;
  WaveformReader reader_;
  std::map<unsigned, WaveformDecomposer> decomposers_;
  Waveform waveform_;
  Decomposition found_;
  Match match_;
};

}  // namespace pcl_als::detail
