// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als::test {

/// Payload of a waveform packet descriptor, field by field.
inline std::string descriptorBytes(unsigned bits, unsigned samples, unsigned spacing_ps = 1000,
                                   double gain = 0.5, double offset = -2.0,
                                   unsigned compression = 0) {
  return Bytes().u8(bits).u8(compression).u32(samples).u32(spacing_ps).f64(gain).f64(offset).str();
}

inline std::string descriptorVlr(unsigned index, const std::string& payload) {
  return LasBytes::vlr("LASF_Spec", 99 + index, payload);
}

/// The 29 bytes of a record that refer to a waveform.
inline std::string referenceBytes(unsigned descriptor, std::uint64_t offset, unsigned bytes,
                                  float location = 12500.0F, float z = 1.5e-4F) {
  return Bytes()
      .u8(descriptor)
      .u64(offset)
      .u32(bytes)
      .f32(location)
      .f32(1e-5F)
      .f32(2e-5F)
      .f32(z)
      .str();
}

/// Position of that reference in the record of a point format.
inline std::size_t referencePosition(int format) {
  return format == 4 ? 28 : format == 5 ? 34 : format == 9 ? 30 : 38;
}

/// A file of waveforms whose packets are in a .wdp: point i has the 256 bytes at 60 + 256 i.
inline LasBytes externalFile(int format) {
  LasBytes las;
  las.format = format;
  las.minor = format < 6 ? 3 : 4;
  las.encoding = 1 | 4;
  las.vlrs = {descriptorVlr(1, descriptorBytes(8, 256))};
  return las;
}

/// Packets of 256 samples of 8 bits: sample k of packet i is 3 k + 7 i, modulo 256.
inline std::string packetPayload(unsigned packets) {
  std::string bytes;
  for (unsigned i = 0; i < packets; ++i)
    for (unsigned k = 0; k < 256; ++k) bytes += static_cast<char>(3 * k + 7 * i);
  return bytes;
}

inline std::string packetRecord(unsigned packets) {
  return LasBytes::evlr("LASF_Spec", 65535, packetPayload(packets));
}

/// Replaces bytes of a text.
inline void put(std::string& bytes, std::size_t at, const std::string& value) {
  bytes.replace(at, value.size(), value);
}

}  // namespace pcl_als::test
