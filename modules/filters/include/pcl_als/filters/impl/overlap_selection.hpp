// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <unordered_map>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/overlap_selection.h>

namespace pcl_als {

template <typename PointT>
void OverlapSelection<PointT>::addOtherStrip(const PointCloudConstPtr& cloud,
                                             const LocalFrame& frame) {
  if (!cloud) throw UsageError("OverlapSelection: the cloud of another strip is null");
  others_.push_back({cloud, frame});
}

template <typename PointT>
void OverlapSelection<PointT>::setOtherStrips(const std::vector<Strip<PointT>>& strips) {
  clearOtherStrips();
  for (const Strip<PointT>& strip : strips) addOtherStrip(strip.cloud, strip.frame);
}

template <typename PointT>
void OverlapSelection<PointT>::setCellSize(double metres) {
  if (!std::isfinite(metres) || metres <= 0.0)
    throw UsageError("OverlapSelection: the cell size must be more than 0 m");
  cell_ = metres;
}

template <typename PointT>
void OverlapSelection<PointT>::setMinimumPoints(std::size_t points) {
  if (points == 0) throw UsageError("OverlapSelection: the minimum must be 1 point or more");
  minimum_points_ = points;
}

template <typename PointT>
std::int64_t OverlapSelection<PointT>::cellOf(const LocalFrame& frame, const PointT& point) const {
  const Eigen::Vector3d ground = frame.toGround(PointFields<PointT>{point}.position());
  const auto column = static_cast<std::int32_t>(std::floor(ground.x() / cell_));
  const auto row = static_cast<std::int32_t>(std::floor(ground.y() / cell_));
  return (row * (std::int64_t{1} << 32)) | static_cast<std::uint32_t>(column);
}

template <typename PointT>
void OverlapSelection<PointT>::addCovered(const Other& other,
                                          std::unordered_set<std::int64_t>& covered) const {
  std::unordered_map<std::int64_t, std::size_t> counts;
  for (const PointT& point : *other.cloud) {
    if (!PointFields<PointT>{point}.isFinite()) continue;
    const std::int64_t cell = cellOf(other.frame, point);
    if (++counts[cell] == minimum_points_) covered.insert(cell);
  }
}

template <typename PointT>
void OverlapSelection<PointT>::requireSameGround(const pcl::Indices& points) const {
  // Metres: floats so far from the origin of the ground frame have steps of 4 mm, so that a cloud
  // relative to it does not reach there.
  constexpr double kFarthest = 50e3;
  const auto first_of = [](const PointCloud& cloud, const LocalFrame& frame) {
    for (const PointT& point : cloud) {
      const PointFields<PointT> fields{point};
      if (fields.isFinite()) return frame.toGround(fields.position());
    }
    return Eigen::Vector3d(Eigen::Vector3d::Constant(std::nan("")));
  };
  if (points.empty()) return;
  const Eigen::Vector3d here = first_of(*this->input_, this->frame_);
  for (const Other& other : others_) {
    if (this->frame_.origin.isZero(0.0) == other.frame.origin.isZero(0.0)) continue;
    const Eigen::Vector3d apart = first_of(*other.cloud, other.frame) - here;
    const double distance = std::hypot(apart.x(), apart.y());
    if (!(distance > kFarthest)) continue;
    throw InputError("OverlapSelection: another strip lies " +
                     std::to_string(std::lround(1e-3 * distance)) +
                     " km from the cloud: call setLocalFrame with the frame of the cloud, and "
                     "addOtherStrip with that of the other strip; one of them is the origin of the "
                     "ground frame");
  }
}

template <typename PointT>
std::vector<bool> OverlapSelection<PointT>::select(const pcl::Indices& points) {
  if (others_.empty()) throw UsageError("OverlapSelection: no other strip is set");
  std::unordered_set<std::int64_t> covered;
  for (const Other& other : others_) addCovered(other, covered);
  requireSameGround(points);
  std::vector<bool> selected;
  selected.reserve(points.size());
  for (const auto index : points) {
    const PointT& point = (*this->input_)[static_cast<std::size_t>(index)];
    selected.push_back(covered.count(cellOf(this->frame_, point)) > 0);
  }
  return selected;
}

}  // namespace pcl_als
