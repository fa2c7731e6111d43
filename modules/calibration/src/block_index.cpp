// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

#include "block.h"

namespace pcl_als {

BlockIndex::BlockIndex(std::shared_ptr<const Trajectory> trajectory, const Eigen::Vector2d& anchor)
    : trajectory_(std::move(trajectory)), map_(anchor), plausibility_(trajectory_) {}

int BlockIndex::addStrip(const std::string& id) {
  strips_.add(id);
  plausibility_.addStrip(id);
  if (!trajectory_->hasAttitude() && !trajectory_->attitudeIsNominal())
    recoveries_.emplace_back(trajectory_);
  if (trajectory_->hasAttitude()) scanners_.emplace_back(trajectory_);
  return map_.addStrip();
}

int BlockIndex::addReference(const ReferenceSurface& surface) {
  strips_.addReference(surface);
  plausibility_.addStrip(surface.name);
  if (!trajectory_->hasAttitude() && !trajectory_->attitudeIsNominal())
    recoveries_.emplace_back(trajectory_);
  return map_.addSurface();
}

void BlockIndex::add(int strip, const LidarReturn* points, std::size_t count) {
  constexpr std::size_t kEvery = 16;  // points used for the attitude and for the scan planes
  map_.add(strip, points, count);
  if (strips_.isReference(strip)) return;
  plausibility_.addRun(strip, points, count);
  for (std::size_t i = 0; i < count && !scanners_.empty(); i += kEvery)
    scanners_[static_cast<std::size_t>(strip)].add(points[i]);
  for (std::size_t i = 0; i < count && !recoveries_.empty(); i += kEvery)
    recoveries_[static_cast<std::size_t>(strip)].add(points[i].time, points[i].position);
}

void BlockIndex::putStrip(int strip, ByteWriter& out) const {
  map_.putStrip(strip, out);
  plausibility_.putStrip(strip, out);
  if (!recoveries_.empty()) recoveries_[static_cast<std::size_t>(strip)].put(out);
  if (!scanners_.empty()) scanners_[static_cast<std::size_t>(strip)].put(out);
}

void BlockIndex::getStrip(int strip, ByteReader& in) {
  map_.getStrip(strip, in);
  plausibility_.getStrip(strip, in);
  if (!recoveries_.empty()) recoveries_[static_cast<std::size_t>(strip)].get(in);
  if (!scanners_.empty()) scanners_[static_cast<std::size_t>(strip)].get(in);
}

}  // namespace pcl_als
