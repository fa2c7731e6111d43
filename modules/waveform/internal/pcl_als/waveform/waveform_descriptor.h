// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include <Eigen/Core>

namespace pcl_als {

class LasFile;
struct LasRecordLayout;

/// How the samples of a waveform packet are stored (LAS 1.4 R15, table "Waveform Packet Descriptor
/// User Defined Record").
struct WaveformDescriptor {
  unsigned bits = 8;                ///< of a sample, 2 to 32
  std::uint32_t samples = 0;        ///< of a packet
  std::uint32_t spacing_ps = 1000;  ///< time between samples, picoseconds
  double gain = 1.0;                ///< volts per digitizer count
  double offset = 0.0;              ///< volts at the count 0

  /// Largest count that the digitizer can give: a sample of this value is saturated.
  double largestCount() const { return static_cast<double>((std::uint64_t{1} << bits) - 1); }
  /// Bytes of a packet if the samples follow each other bit by bit.
  std::uint64_t packedBytes() const { return (std::uint64_t{samples} * bits + 7) / 8; }
  /// Bytes of a packet if every sample begins at a byte.
  std::uint64_t alignedBytes() const { return std::uint64_t{samples} * ((bits + 7) / 8); }
  /// "64 samples of 8 bits, 1000 ps apart".
  std::string describe() const;
};

/** \brief Reads the waveform packet descriptors of a file: VLRs or EVLRs LASF_Spec 100 to 354.
 *
 * \return descriptors by the index that point records refer to, record id - 99; those without
 * samples are ignored, because some writers fill a table with them.
 * InputError, which names the file and the record, for a record that is too short, bits per sample
 * outside 2 to 32, a compression that the specification does not define, no time between samples, a
 * gain that is zero or no number, an offset that is no number, and for two records
 * of one id that differ.
 */
std::map<unsigned, WaveformDescriptor> readWaveformDescriptors(const LasFile& las);

/** \brief Where the waveform of a point is stored, and where it lies in space (point formats 4, 5,
 * 9 and 10).
 *
 * The point is at the time \a location of the waveform. The position at the time t, counted from
 * the first sample, is point + (location - t) direction, with the direction from the point towards
 * the anchor point at the first sample (LAS 1.4 R15, "Parametric dx, dy, dz").
 */
struct WaveformReference {
  unsigned descriptor = 0;        ///< index of the descriptor; 0: the point has no waveform
  std::uint64_t byte_offset = 0;  ///< of the packet, from the header of the record of packets
  std::uint32_t bytes = 0;        ///< of the packet
  float location_ps = 0.0F;  ///< of the point in the waveform, picoseconds from the first sample
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  ///< units of the file per picosecond

  /// \pre layout.waveform >= 0
  static WaveformReference of(const std::byte* record, const LasRecordLayout& layout);
  void store(std::byte* record, const LasRecordLayout& layout) const;

  /// Displacement per picosecond of growing time along the pulse, away from the sensor, in units of
  /// the file. The direction of the specification points to the anchor, upwards from an aircraft;
  /// files whose direction points downwards have the opposite sign.
  Eigen::Vector3d alongPulse() const {
    const Eigen::Vector3d d = direction.cast<double>();
    return d.z() > 0.0 ? Eigen::Vector3d(-d) : d;
  }
};

}  // namespace pcl_als
