// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// Finds the areas that cover a point, for sorting points into areas while files are read.
class AreaIndex {
 public:
  explicit AreaIndex(const std::vector<SurveyArea>& areas);
  /// Indices of the areas whose square with margin may contain the position.
  const std::vector<int>& candidates(const Eigen::Vector3d& position) const;

 private:
  std::unordered_map<std::int64_t, std::vector<int>> cells_;
  std::vector<int> none_;
};

}  // namespace pcl_als
