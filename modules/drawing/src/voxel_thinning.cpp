// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/drawing/voxel_thinning.h>

namespace pcl_als {
namespace {

constexpr double kMostSteps = 1048576.0;  // 2^20 cubes each way from the centre: 21 bits

}  // namespace

VoxelThinning::VoxelThinning(const Eigen::Vector3d& center, const Eigen::Vector3d& size,
                             std::size_t most)
    : center_(center), most_(std::max<std::size_t>(8, most)) {
  const double extent = std::max(1.0, size.cwiseAbs().maxCoeff());
  cube_ = std::max(0.01, 2.0 * extent / kMostSteps);
}

std::uint64_t VoxelThinning::keyOf(const Eigen::Vector3d& offset) const {
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k) {
    const double step = std::clamp(std::floor(offset[k] / cube_), -kMostSteps, kMostSteps - 1.0);
    key = key << 21U | static_cast<std::uint64_t>(step + kMostSteps);
  }
  return key;
}

void VoxelThinning::add(const Eigen::Vector3d& ground, float value) {
  if (!ground.allFinite()) return;
  const Eigen::Vector3d offset = ground - center_;
  if (!taken_.insert(keyOf(offset)).second) return;
  positions_.push_back(offset.cast<float>());
  values_.push_back(value);
  while (positions_.size() > most_) coarsen();
}

void VoxelThinning::coarsen() {
  cube_ *= 2.0;
  taken_.clear();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    if (!taken_.insert(keyOf(positions_[i].cast<double>())).second) continue;
    positions_[kept] = positions_[i];
    values_[kept++] = values_[i];
  }
  positions_.resize(kept);
  values_.resize(kept);
}

}  // namespace pcl_als
