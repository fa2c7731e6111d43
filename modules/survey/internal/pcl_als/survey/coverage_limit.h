// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>

namespace pcl_als {

/// Whether points of a file that no trajectory covers may stay unchanged by default: a few at the
/// ends of a flight line are usual, while many indicate the trajectory of another flight.
inline bool fewUncovered(std::uint64_t uncovered, std::uint64_t points) {
  constexpr double kFew = 0.01;
  return static_cast<double>(uncovered) <= kFew * static_cast<double>(points);
}

}  // namespace pcl_als
