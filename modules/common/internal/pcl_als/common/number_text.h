// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace pcl_als {

/// "1 strip", "2 strips": a count with its noun, which takes an s.
inline std::string counted(std::uint64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// 1843200 → "1 843 200".
inline std::string grouped(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), " ");
  return digits;
}

/// At most ten significant digits: 0.3 → "0.3", not the digits of the nearest double.
inline std::string shortText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

/// Digits after the point that distinguish multiples of a step.
int decimalsOf(double step);

/// A number with a given number of decimals; minus is a true minus sign, and zero has no sign.
std::string numberText(double value, int decimals);
/// A number with a given number of significant digits, never as a power of ten.
std::string significantText(double value, int digits);
/// "0.25 m", "50 m", "2 km"
std::string lengthText(double metres);

}  // namespace pcl_als
