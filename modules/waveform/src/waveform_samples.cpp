// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/las/las_record.h>
#include <pcl_als/waveform/waveform_reader.h>

namespace pcl_als {
namespace {

template <typename T>
void unpackIntegers(const std::byte* packet, std::size_t samples, double* counts) {
  for (std::size_t i = 0; i < samples; ++i)
    counts[i] = static_cast<double>(loadLas<T>(packet + i * sizeof(T)));
}

/// Integers of \a width bytes.
void unpackBytes(const std::byte* packet, std::size_t samples, std::size_t width, double* counts) {
  for (std::size_t i = 0; i < samples; ++i) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < width; ++k)
      value |= std::to_integer<std::uint32_t>(packet[i * width + k]) << (8 * k);
    counts[i] = value;
  }
}

void unpackBits(const std::byte* packet, std::size_t samples, unsigned bits, double* counts) {
  const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
  std::uint64_t pending = 0;
  unsigned available = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    for (; available < bits; available += 8)
      pending |= std::to_integer<std::uint64_t>(*packet++) << available;
    counts[i] = static_cast<double>(pending & mask);
    pending >>= bits;
    available -= bits;
  }
}

}  // namespace

void unpackWaveform(const std::byte* packet, std::uint64_t bytes,
                    const WaveformDescriptor& descriptor, double* counts) {
  const std::size_t samples = descriptor.samples;
  const bool packed = bytes == descriptor.packedBytes() && bytes != descriptor.alignedBytes();
  if (packed) return unpackBits(packet, samples, descriptor.bits, counts);
  switch ((descriptor.bits + 7) / 8) {
    case 1:
      return unpackIntegers<std::uint8_t>(packet, samples, counts);
    case 2:
      return unpackIntegers<std::uint16_t>(packet, samples, counts);
    case 3:
      return unpackBytes(packet, samples, 3, counts);
    default:
      return unpackIntegers<std::uint32_t>(packet, samples, counts);
  }
}

std::vector<std::byte> packWaveform(const std::vector<double>& counts, unsigned bits) {
  const double largest = static_cast<double>((std::uint64_t{1} << bits) - 1);
  std::vector<std::byte> packet((counts.size() * bits + 7) / 8);
  std::uint64_t pending = 0;
  unsigned available = 0;
  std::size_t at = 0;
  for (const double count : counts) {
    if (!(count >= 0.0 && count <= largest))
      throw UsageError("a sample of " + shortText(count) + " does not fit into " +
                       counted(bits, "bit"));
    pending |= static_cast<std::uint64_t>(std::llround(count)) << available;
    for (available += bits; available >= 8; available -= 8, pending >>= 8U)
      packet[at++] = static_cast<std::byte>(pending & 255U);
  }
  if (available > 0) packet[at] = static_cast<std::byte>(pending & 255U);
  return packet;
}

}  // namespace pcl_als
