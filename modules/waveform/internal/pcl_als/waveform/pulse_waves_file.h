// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/las/las_header.h>
#include <pcl_als/waveform/waveform_descriptor.h>

namespace pcl_als {

/// How a waveform of a pulse is stored in the Waves file ("Sampling Record").
struct PulseSampling {
  enum class Type { undefined = 0, outgoing = 1, returning = 2 };

  Type type = Type::undefined;
  unsigned channel = 0;  ///< of the receiver, for waveforms that several sensors digitise
  unsigned duration_bits = 0, segment_bits = 0, sample_bits = 0;  ///< of the numbers; 0: fixed
  double duration_scale = 1.0, duration_offset = 0.0;             ///< to sampling units
  std::uint32_t segments = 1, samples = 0;                        ///< where these are fixed
  unsigned bits = 8;                                              ///< of a sample, 8 or 16
  unsigned table = 0;                                             ///< lookup table, 0: none
  double spacing_ns = 1.0;                                        ///< time between samples
  std::string description;
  /// Index in PulseWavesFile::waveformDescriptors(); 0 if the sampling is not a returning one.
  unsigned waveform = 0;
};

/// Samplings of a pulse and their time unit ("Composition Record").
struct PulseDescriptor {
  /// Time from the optical centre to the anchor, sampling units, if it is constant.
  std::optional<double> centre_to_anchor;
  double unit_ns = 1.0;       ///< the sampling unit
  unsigned extra_bytes = 0;   ///< before the samplings of a pulse in the Waves file
  std::uint32_t scanner = 0;  ///< 0: none is stated
  std::vector<PulseSampling> samplings;
  std::string description;
};

/// "Scanner VLR": what the writer knew of the instrument. Zero: not stated.
struct PulseScanner {
  std::string instrument, serial, description;
  float wavelength_nm = 0.0F, pulse_width_ns = 0.0F;
  std::uint32_t pattern = 0, facets = 0;
  float scan_frequency_hz = 0.0F, least_angle_deg = 0.0F, largest_angle_deg = 0.0F;
  float pulse_frequency_khz = 0.0F, beam_diameter_mm = 0.0F, divergence_mrad = 0.0F;
  float least_range = 0.0F, largest_range = 0.0F;  ///< metres
};

/// "Lookup Table Record": one value for each value of a sample.
struct SampleTable {
  unsigned unit = 0;  ///< 0: undefined, 1: intensity correction, 2: range correction
  std::string description;
  std::vector<float> entries;
};

struct PulseWavesHeader {
  int version_major = 0, version_minor = 3;
  std::uint32_t file_source_id = 0;
  std::string system_id, generating_software;
  std::uint16_t header_size = 352;
  std::uint64_t pulse_offset = 0, pulse_count = 0;
  std::uint32_t attributes = 0, record_length = 48;
  std::uint32_t vlr_count = 0;
  std::int32_t avlr_count = 0;                        ///< -1: as many as there are
  double time_scale = 1e-6, time_offset = 0.0;        ///< seconds
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();    ///< units of the file per step
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();   ///< units of the file
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();  ///< of the sampled parts, as stated
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
};

/// A pulse ("Pulse Record Type 0"). Coordinates are those of the file.
struct PulseRecord {
  std::int64_t time = 0;                  ///< GPS time, steps: PulseWavesHeader::time_scale
  std::int64_t waves_offset = 0;          ///< of its waves, bytes from the start of the Waves file
  Eigen::Vector3d anchor, target;         ///< the target is 1000 sampling units behind the anchor
  int first_sample = 0, last_sample = 0;  ///< returning, sampling units from the anchor
  unsigned descriptor = 0;                ///< 0: the pulse has no waveform
  bool edge = false, scan_direction = false;
  unsigned facet = 0, intensity = 0, classification = 0;
  std::uint32_t source_id = 0;  ///< that of the file, if pulses have none

  /// Displacement in a sampling unit, away from the scanner.
  Eigen::Vector3d direction() const { return (target - anchor) / 1000.0; }
};

/** \brief The Pulse file (.pls) of PulseWaves 0.3 revision 11: pulses, and how their waveforms are
 * sampled.
 *
 * The constructor checks the header and all records that describe pulses against the size of the
 * file. Appended records are read as the others. Const member functions may be called by several
 * threads.
 *
 * Source: M. Isenburg, "PulseWaves - Full Waveform LiDAR Specification", 0.3 revision 11.
 */
class PulseWavesFile {
 public:
  /** InputError, one line that names the file and the record, for compressed files (.plz),
   * pulses past the end of the file, another pulse format than 0, scales that are no positive
   * numbers, and for a descriptor, scanner or table that contradicts itself or occurs twice with
   * different values.
   */
  explicit PulseWavesFile(const std::filesystem::path& path);
  ~PulseWavesFile();
  PulseWavesFile(const PulseWavesFile&) = delete;
  PulseWavesFile& operator=(const PulseWavesFile&) = delete;

  const std::filesystem::path& path() const;
  const PulseWavesHeader& header() const;
  const std::map<unsigned, PulseDescriptor>& descriptors() const;
  const std::map<unsigned, PulseScanner>& scanners() const;
  const std::map<unsigned, std::vector<SampleTable>>& tables() const;
  /// The coordinate reference system, as records of a LAS file (LASF_Projection).
  const std::vector<LasVlr>& projection() const;
  /// One for each kind of returning samplings: those of one scanner, channel, size and spacing of
  /// samples and lookup table. The number of samples varies and is given as 0.
  const std::map<unsigned, WaveformDescriptor>& waveformDescriptors() const;

  /// Reads pulses first, first + 1, …. \pre they exist
  void read(std::uint64_t first, std::size_t count, std::vector<PulseRecord>& pulses) const;
  /// Seconds of the GPS week, or seconds of standard GPS time less 1e9 (adjusted standard time).
  double timeOf(const PulseRecord& pulse) const;
  /// Whether times are standard GPS time: they exceed the seconds of a week.
  bool hasStandardTime() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Whether a file is a Pulse file by its name: .pls, or .plz, which is refused when it is read.
bool isPulseFile(const std::filesystem::path& path);

/// Texts that describe a file: pulses, scanners, samplings, lookup tables, and the Waves file.
std::vector<std::string> describePulseWaves(const PulseWavesFile& file);

}  // namespace pcl_als
