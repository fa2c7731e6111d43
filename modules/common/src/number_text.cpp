// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/common/number_text.h>

namespace pcl_als {

int decimalsOf(double step) {
  return std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
}

std::string numberText(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, std::abs(value));
  const std::string digits = text.data();
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  return (value < 0.0 && !zero ? "−" : "") + digits;
}

std::string significantText(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return numberText(value, 0);
  const int leading = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
  return numberText(value, std::clamp(digits - 1 - leading, 0, 12));
}

std::string lengthText(double metres) {
  if (metres >= 1000.0) return numberText(metres / 1000.0, decimalsOf(metres / 1000.0)) + " km";
  return numberText(metres, decimalsOf(metres)) + " m";
}

}  // namespace pcl_als
