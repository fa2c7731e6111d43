// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

namespace pcl_als {

/// Which areas of a block SurveyMap::selectAreas() chooses.
struct AreaSelection {
  double area_size = 50.0;  ///< metres
  double margin = 8.0;      ///< metres
  /// points in the chosen areas and their margins, all strips
  std::size_t point_budget = 4'000'000;
};

}  // namespace pcl_als
