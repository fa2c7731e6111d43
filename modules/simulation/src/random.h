// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als::simulation {

/// The finaliser of SplitMix64: a bijection of 64 bits that passes for a random function.
inline std::uint64_t mixBits(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

/// A key from several numbers; independent streams come from different keys.
inline std::uint64_t keyOf(std::initializer_list<std::uint64_t> parts) {
  std::uint64_t key = 0x9E3779B97F4A7C15ULL;
  for (const std::uint64_t part : parts) key = mixBits(key + 0x9E3779B97F4A7C15ULL * (part + 1));
  return key;
}

/// Top 53 bits as a number in [0, 1).
inline double unitOf(std::uint64_t bits) {
  return static_cast<double>(bits >> 11U) * 0x1.0p-53;
}

/** \brief SplitMix64 from a key: cheap to start, so every pulse has its own.
 *
 * The standard library's distributions differ between implementations; these do not.
 */
class Random {
 public:
  explicit Random(std::uint64_t key) : state_(key) {}

  double uniform() { return unitOf(mixBits(state_ += 0x9E3779B97F4A7C15ULL)); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  bool chance(double probability) { return uniform() < probability; }
  /// Standard normal (Box and Muller); the second of each pair is kept for the next call.
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    const double angle = 2.0 * kPi * uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
  }

 private:
  std::uint64_t state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace pcl_als::simulation
