// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/errors.h>
#include <pcl_als/visualization/ticks.h>

namespace pcl_als {
namespace {

int decimalsOf(double step) {
  return std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
}

}  // namespace

double roundDown125(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit) + 1e-9));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= limit * (1.0 + 1e-9)) return factor * power;
  }
  return power;
}

Ticks niceTicks(double low, double high, int most) {
  if (!(low < high) || !std::isfinite(low) || !std::isfinite(high)) {
    throw UsageError("an axis needs two finite ends, the lower first");
  }
  Ticks ticks;
  ticks.step = roundDown125((high - low) / std::max(1, most));
  const auto count = [&](double step) {
    return std::floor(high / step + 1e-9) - std::ceil(low / step - 1e-9) + 1.0;
  };
  while (count(ticks.step) > std::max(2, most)) {
    const double mantissa = ticks.step / std::pow(10.0, std::floor(std::log10(ticks.step) + 1e-9));
    ticks.step *= mantissa > 1.5 && mantissa < 3.0 ? 2.5 : 2.0;
  }
  ticks.decimals = decimalsOf(ticks.step);
  const double first = std::ceil(low / ticks.step - 1e-9);
  for (double i = first; i * ticks.step <= high + 1e-9 * ticks.step; ++i) {
    ticks.values.push_back(i * ticks.step);
  }
  return ticks;
}

std::string Ticks::label(double value) const {
  return numberText(value, decimals);
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

std::string countText(std::size_t count) {
  std::string digits = std::to_string(count);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), " ");
  }
  return digits;
}

std::string lengthText(double metres) {
  if (metres >= 1000.0) return numberText(metres / 1000.0, decimalsOf(metres / 1000.0)) + " km";
  return numberText(metres, decimalsOf(metres)) + " m";
}

}  // namespace pcl_als
