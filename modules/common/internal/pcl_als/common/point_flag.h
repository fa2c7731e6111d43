// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>

namespace pcl_als {

/// Bits of PointLidar::flags, as LAS 1.4 names them; bits 6 and 7 hold the scanner channel.
enum PointFlag : std::uint8_t {
  kSynthetic = 1,
  kKeyPoint = 2,
  kWithheld = 4,
  kOverlap = 8,
  kScanDirection = 16,
  kEdgeOfFlightLine = 32,
};

}  // namespace pcl_als
