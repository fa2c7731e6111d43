// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "waveform_pulses.h"

#include <algorithm>

#include <pcl_als/waveform/waveform_descriptor.h>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kBlockRecords = std::size_t{1} << 16;
constexpr std::size_t kRemembered = std::size_t{1} << 20;
/// Records of one pulse at most; a file whose points all refer to one packet is cut here.
constexpr std::size_t kMostRecords = 64;

bool sameWaveform(const WaveformReference& a, const WaveformReference& b) {
  return a.descriptor != 0 && a.descriptor == b.descriptor && a.byte_offset == b.byte_offset;
}

/// Divides records into pulses. \return the number of records in complete pulses
std::size_t divide(const LasFile& las, const std::vector<std::byte>& records, std::size_t count,
                   std::uint64_t first, bool last, PacketMemory& memory,
                   std::vector<WaveformPulse>& pulses) {
  const std::size_t length = las.header().record_length;
  pulses.clear();
  std::size_t from = 0;
  while (from < count) {
    const WaveformReference own = WaveformReference::of(&records[from * length], las.layout());
    std::size_t to = from + 1;
    while (to < count && to - from < kMostRecords &&
           sameWaveform(own, WaveformReference::of(&records[to * length], las.layout())))
      ++to;
    if (to == count && !last && from > 0) break;
    const bool repeated = own.descriptor != 0 && memory.meets(own.byte_offset);
    pulses.push_back({&records[from * length], to - from, first + from, repeated});
    from = to;
  }
  return from;
}

}  // namespace

PacketMemory::PacketMemory() : last_(kRemembered, ~std::uint64_t{0}) {}

bool PacketMemory::meets(std::uint64_t offset) {
  constexpr std::uint64_t kOddFactor = 0x9E3779B97F4A7C15;  // multiplicative hashing
  std::uint64_t& place = last_[(offset * kOddFactor) >> 44U];
  const bool met = place == offset;
  place = offset;
  return met;
}

void readPulses(const LasFile& las,
                const std::function<void(const std::vector<WaveformPulse>&)>& take) {
  const std::size_t length = las.header().record_length;
  const std::uint64_t all = las.header().point_count;
  std::vector<std::byte> records;
  std::vector<WaveformPulse> pulses;
  PacketMemory memory;
  std::size_t kept = 0;  // records of the last pulse of the block before
  for (std::uint64_t read = 0; read < all;) {
    const std::size_t more = std::min<std::uint64_t>(kBlockRecords, all - read);
    records.resize((kept + more) * length);
    las.readRecords(read, more, &records[kept * length]);
    const std::uint64_t first = read - kept;
    read += more;
    const std::size_t done = divide(las, records, kept + more, first, read == all, memory, pulses);
    take(pulses);
    kept += more - done;
    std::copy(records.end() - static_cast<std::ptrdiff_t>(kept * length), records.end(),
              records.begin());
  }
}

}  // namespace pcl_als::detail
