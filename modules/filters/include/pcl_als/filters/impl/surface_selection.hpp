// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <limits>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/filters/surface_selection.h>

namespace pcl_als {

template <typename PointT>
bool SurfaceSelection<PointT>::isSurfacePoint(const PointFields<PointT>& point) {
  const int code = point.classification();
  const bool vegetation = code >= 3 && code <= 5, noise = code == 7 || code == 18;
  return point.isFinite() && point.returnNumber() >= point.numberOfReturns() && !vegetation &&
         !noise && (point.flags() & kWithheld) == 0;
}

template <typename PointT>
std::vector<bool> SurfaceSelection<PointT>::select(const pcl::Indices& points) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::size_t> place(this->input_->size(), kNone);
  for (std::size_t i = 0; i < this->input_->size(); ++i) {
    const PointFields<PointT> point{(*this->input_)[i]};
    if (!isSurfacePoint(point)) continue;
    place[i] = positions.size();
    positions.push_back(this->frame_.toGround(point.position()));
  }
  SuitablePointsSettings settings = settings_;
  settings.threads = this->threads_;
  const std::vector<bool> suitable = suitablePoints(positions, criterion_, settings);
  std::vector<bool> selected;
  selected.reserve(points.size());
  for (const auto index : points) {
    const auto i = static_cast<std::size_t>(index);
    const bool single = PointFields<PointT>{(*this->input_)[i]}.numberOfReturns() <= 1;
    selected.push_back(place[i] != kNone && suitable[place[i]] && (single || multiple_returns_));
  }
  return selected;
}

}  // namespace pcl_als
