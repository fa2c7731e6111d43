// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include "las_bytes.h"

namespace pcl_als::test {

/// A descriptor of extra bytes (LAS 1.4 R15, table 25), put together by hand.
struct Descriptor {
  unsigned type = 3;  ///< unsigned 16-bit
  unsigned options = 0;
  std::string name;
  double no_data = 0.0, least = 0.0, most = 0.0, scale = 0.0, offset = 0.0;

  std::string str() const {
    Bytes b;
    b.u16(0xABCD).u8(type).u8(options).text(name, 32).text("un", 4);
    for (const double value : {no_data, least, most, scale, offset})
      b.f64(value).f64(value + 1.0).f64(value + 2.0);
    return b.text("about " + name, 32).str();
  }
};

inline std::string extraBytesVlr(const std::string& descriptors) {
  return LasBytes::vlr("LASF_Spec", 4, descriptors);
}

}  // namespace pcl_als::test
