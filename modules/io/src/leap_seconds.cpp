// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "leap_seconds.h"

#include <array>

namespace pcl_als::detail {

double leapSecondsAt(double gps_seconds) {
  // GPS time from which on the difference holds; the last entry holds until another leap second is
  // announced.
  constexpr std::array<std::array<double, 2>, 6> kTable = {{{0.0, 13.0},
                                                            {820108814.0, 14.0},
                                                            {914803215.0, 15.0},
                                                            {1025136016.0, 16.0},
                                                            {1119744017.0, 17.0},
                                                            {1167264018.0, 18.0}}};
  double seconds = kTable[0][1];
  for (const auto& [from, value] : kTable) {
    if (gps_seconds >= from) seconds = value;
  }
  return seconds;
}

}  // namespace pcl_als::detail
