// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/waveform/waveform_descriptor.h>

namespace pcl_als {

class LasFile;

/// The digitised waveform of a point.
struct Waveform {
  WaveformReference reference;
  WaveformDescriptor descriptor;
  std::vector<double> counts;  ///< digitizer counts, descriptor.samples of them

  double volts(std::size_t sample) const {
    return descriptor.offset + descriptor.gain * counts[sample];
  }
};

/** \brief The waveform packets of a LAS or LAZ file, in the file or in the .wdp beside it.
 *
 * Const member functions may be called by several threads. Packets within a file are found by the
 * position in its header (LAS 1.3 and later) or by the EVLR LASF_Spec 65535.
 */
class WaveformSource {
 public:
  /** \param las must exist as long as the source.
   *
   * InputError for descriptors that are damaged (readWaveformDescriptors()), point formats without
   * waveforms, a missing .wdp, a compressed .wdz, and a header that states a record of packets
   * which is not there.
   */
  explicit WaveformSource(const LasFile& las);
  ~WaveformSource();
  WaveformSource(const WaveformSource&) = delete;
  WaveformSource& operator=(const WaveformSource&) = delete;

  const LasFile& las() const;
  const std::map<unsigned, WaveformDescriptor>& descriptors() const;
  /// Name of the file that has the packets.
  const std::string& packetFile() const;
  /// Bytes from the header of the record of packets to its end.
  std::uint64_t packetBytes() const;
  /// Reads bytes of the record of packets, counted from its header.
  void read(std::uint64_t offset, std::size_t bytes, std::byte* out) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/** \brief Reads the waveforms of points, in any order; fast in the order of the packets.
 *
 * A reader has a buffer of its own, so that each thread needs one.
 * \code
 * const LasFile las("strip1.las");
 * const WaveformSource source(las);
 * WaveformReader reader(source);
 * Waveform waveform;
 * if (reader.read(record, 12, waveform)) use(waveform.counts);
 * \endcode
 */
class WaveformReader {
 public:
  explicit WaveformReader(const WaveformSource& source) : source_(source) {}

  /** \brief Reads the waveform that a point record refers to.
   *
   * \param point index of the record, for messages
   * \return false if the point has no waveform
   * InputError "FILE: point N: …" for a descriptor that the file lacks, a size of the packet that
   * the descriptor contradicts, a packet that reaches past the end of the packets, and a location
   * or a direction that is no number.
   */
  bool read(const std::byte* record, std::uint64_t point, Waveform& waveform);
  /// The same for a reference that was read before.
  bool read(const WaveformReference& reference, std::uint64_t point, Waveform& waveform);

 private:
  const std::byte* packet(std::uint64_t offset, std::size_t bytes);

  const WaveformSource& source_;
  std::vector<std::byte> buffer_;
  std::uint64_t begin_ = 0, end_ = 0;  ///< of the record of packets in the buffer
};

/** \brief Unpacks the samples of a packet.
 *
 * Samples of 8, 16, 24 and 32 bits are little-endian integers. Samples of other sizes are either
 * packed, least significant bit first, or stored in the next whole number of bytes, according to
 * the size of the packet. \pre bytes is descriptor.packedBytes() or descriptor.alignedBytes()
 */
void unpackWaveform(const std::byte* packet, std::uint64_t bytes,
                    const WaveformDescriptor& descriptor, double* counts);

/// The inverse of unpackWaveform(), packed. UsageError for a count that the bits cannot hold.
std::vector<std::byte> packWaveform(const std::vector<double>& counts, unsigned bits);

/// One text for each waveform packet descriptor of a file, and one for packets within it (those in
/// another file: ExternalWaveforms::describe()); empty if its records do not refer to waveforms.
/// InputError as readWaveformDescriptors().
std::vector<std::string> describeWaveforms(const LasFile& las);

}  // namespace pcl_als
