// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "waveform_pulses.h"

#include <algorithm>

#include <pcl_als/waveform/pulse_echoes.h>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kBlockRecords = std::size_t{1} << 16;
/// Divides records into pulses.
/// \param memory null: \a repeated stays false
/// \return the number of records in complete pulses
std::size_t divide(const LasFile& las, const std::vector<std::byte>& records, std::size_t count,
                   std::uint64_t first, bool last, PacketMemory* memory,
                   std::vector<WaveformPulse>& pulses) {
  const std::size_t length = las.header().record_length;
  pulses.clear();
  std::size_t from = 0;
  while (from < count) {
    const WaveformReference own = WaveformReference::of(&records[from * length], las.layout());
    std::size_t to = from + 1;
    while (to < count && to - from < kMostPointsOfPulse &&
           sameWaveform(own, WaveformReference::of(&records[to * length], las.layout())))
      ++to;
    if (to == count && !last && from > 0) break;
    const bool repeated =
        memory != nullptr && own.descriptor != 0 && memory->meets(own.byte_offset);
    pulses.push_back({&records[from * length], to - from, first + from, repeated});
    from = to;
  }
  return from;
}

}  // namespace

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
    const std::size_t done = divide(las, records, kept + more, first, read == all, &memory, pulses);
    take(pulses);
    kept += more - done;
    std::copy(records.end() - static_cast<std::ptrdiff_t>(kept * length), records.end(),
              records.begin());
  }
}

void readPulseRun(const LasFile& las, std::uint64_t first, std::size_t count,
                  const std::function<void(const WaveformPulse&)>& take) {
  std::vector<std::byte> records(count * las.header().record_length);
  las.readRecords(first, count, records.data());
  std::vector<WaveformPulse> pulses;
  divide(las, records, count, first, true, nullptr, pulses);
  for (const WaveformPulse& pulse : pulses) take(pulse);
}

}  // namespace pcl_als::detail
