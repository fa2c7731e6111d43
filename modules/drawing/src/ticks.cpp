// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/ticks.h>

namespace pcl_als {
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

}  // namespace pcl_als
