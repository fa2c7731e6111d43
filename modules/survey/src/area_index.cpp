// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/survey/area_index.h>
#include <pcl_als/survey/survey_map.h>

namespace pcl_als {

AreaIndex::AreaIndex(const std::vector<SurveyArea>& areas) {
  for (std::size_t index = 0; index < areas.size(); ++index) {
    const SurveyArea& area = areas[index];
    const auto cell = [](double v) {
      return static_cast<std::int64_t>(std::floor(v / SurveyMap::kCell));
    };
    const Eigen::Vector2d low = area.minimum.array() - area.margin;
    const Eigen::Vector2d high = area.minimum.array() + area.size + area.margin;
    for (std::int64_t row = cell(low.y()); row <= cell(high.y()); ++row) {
      for (std::int64_t column = cell(low.x()); column <= cell(high.x()); ++column) {
        cells_[(row * (std::int64_t{1} << 32)) ^ (column & 0xffffffff)].push_back(
            static_cast<int>(index));
      }
    }
  }
}

const std::vector<int>& AreaIndex::candidates(const Eigen::Vector3d& position) const {
  const auto row = static_cast<std::int64_t>(std::floor(position.y() / SurveyMap::kCell));
  const auto column = static_cast<std::int64_t>(std::floor(position.x() / SurveyMap::kCell));
  const auto found = cells_.find((row * (std::int64_t{1} << 32)) ^ (column & 0xffffffff));
  return found == cells_.end() ? none_ : found->second;
}

}  // namespace pcl_als
