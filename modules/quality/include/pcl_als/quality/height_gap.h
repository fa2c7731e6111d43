// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/quality/area_offsets.h>

namespace pcl_als {

/// Height difference of two strips of any size, for offsets beyond the largest distance at which
/// places are compared.
struct HeightGap {
  double median = 0.0;    ///< a - b, metres, of the lowest points of cells
  std::size_t cells = 0;  ///< of kCell metres that both strips have points in

  static constexpr double kCell = 2.0;
};

/// From the cells of the areas; empty where fewer than 20 are shared. At most some hundred thousand
/// points are used.
std::optional<HeightGap> heightGap(const std::vector<AreaOffsets>& areas, int a, int b);

/// The reason for which places of \a a and \a b cannot be compared, in one line; empty where the
/// difference is less than \a maximum_distance (metres).
std::string describeGap(const HeightGap& gap, const std::string& a, const std::string& b,
                        double maximum_distance);

}  // namespace pcl_als
