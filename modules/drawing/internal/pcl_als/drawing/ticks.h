// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/number_text.h>

namespace pcl_als {

/// Ticks of an axis: multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
  double step = 1.0;
  int decimals = 0;  ///< digits after the point that distinguish neighbouring ticks
  std::vector<double> values;

  std::string label(double value) const;
};

/// Ticks inside [low, high], at most \a most (at least two) of them; low < high, both finite.
Ticks niceTicks(double low, double high, int most);

/// The largest of 1, 2, 5 times a power of ten that is not above \a limit (> 0).
double roundDown125(double limit);

}  // namespace pcl_als
