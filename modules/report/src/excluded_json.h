// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include <pcl_als/common/excluded_points.h>

namespace pcl_als {

/// The array `left_out` of result files.
inline nlohmann::ordered_json excludedJson(const std::vector<ExcludedPoints>& parts) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ExcludedPoints& part : parts)
    list.push_back({{"strip", part.strip},
                    {"reason", toString(part.reason)},
                    {"points", part.points},
                    {"of", part.of}});
  return list;
}

}  // namespace pcl_als
