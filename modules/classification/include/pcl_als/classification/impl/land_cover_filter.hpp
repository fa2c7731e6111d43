// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <vector>

#include <pcl_als/classification/land_cover_filter.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {

template <typename PointT>
void LandCoverFilter<PointT>::applyFilter(PointCloud& output) {
  if (!classifier_) throw UsageError("LandCoverFilter: no classifier is set");
  std::vector<std::uint8_t> codes;
  for (const GaussianClass& c : classifier_->model().classes) {
    const auto given = codes_.find(c.name);
    codes.push_back(given == codes_.end() ? asprsCodeOf(c.name) : given->second);
  }
  unclassified_ = 0;
  output = *this->input_;
  for (const auto index : *this->indices_) {
    auto& point = output[static_cast<std::size_t>(index)];
    const bool finite = std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
    MaximumLikelihood::Decision decision;
    if (finite && !isNoise(static_cast<std::uint8_t>(point.classification))) {
      const Eigen::Vector3d ground = frame_.toGround({point.x, point.y, point.z});
      decision = classifier_->classify(ground.x(), ground.y(), ground.z(),
                                       static_cast<double>(point.intensity));
    }
    if (decision.index == MaximumLikelihood::kNoClass) {
      ++unclassified_;
    } else {
      point.classification = codes[static_cast<std::size_t>(decision.index)];
    }
  }
}

}  // namespace pcl_als
