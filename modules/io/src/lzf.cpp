// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "lzf.h"

#include <cstring>

namespace pcl_als::detail {

// The format: a control byte below 32 announces that many literals plus one. Otherwise its upper
// three bits are the length of a copy minus 2 (7: another byte adds to it) and its lower five, with
// the next byte, the distance back minus 1.
bool decompressLzf(const std::byte* in, std::size_t in_size, std::byte* out, std::size_t out_size) {
  std::size_t i = 0, o = 0;
  while (i < in_size) {
    const auto control = std::to_integer<std::size_t>(in[i++]);
    if (control < 32) {
      const std::size_t count = control + 1;
      if (count > in_size - i || count > out_size - o) return false;
      std::memcpy(out + o, in + i, count);
      i += count;
      o += count;
      continue;
    }
    std::size_t length = control >> 5U;
    if (length == 7) {
      if (i >= in_size) return false;
      length += std::to_integer<std::size_t>(in[i++]);
    }
    length += 2;
    if (i >= in_size) return false;
    const std::size_t distance =
        (((control & 31U) << 8U) | std::to_integer<std::size_t>(in[i++])) + 1;
    if (distance > o || length > out_size - o) return false;
    // The ranges overlap where the copy repeats a short pattern, so byte after byte.
    for (std::size_t k = 0; k < length; ++k, ++o) out[o] = out[o - distance];
  }
  return o == out_size;
}

}  // namespace pcl_als::detail
