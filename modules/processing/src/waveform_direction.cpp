// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "waveform_direction.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <pcl_als/waveform/waveform_descriptor.h>

namespace pcl_als::detail {
namespace {

/// Time between a point and the second one, 300 m behind it: steps of 1 mm turn the direction by
/// less than 1e-5.
constexpr double kDisplacementPs = 2e6;
constexpr std::size_t kCoordinateBytes = 12;

bool fits(double value) {
  return std::abs(value) < std::numeric_limits<std::int32_t>::max();
}

}  // namespace

DisplacedPoints::DisplacedPoints(const LasFile& file, const LasRecordBlock& block)
    : layout_(file.layout()), scale_(file.header().scale) {
  if (!any()) return;
  records_.assign(block.records, block.records + block.count * block.record_length);
  before_ = records_;
  displaced_.assign(block.count, false);
  for (std::size_t i = 0; i < block.count; ++i) {
    std::byte* record = &records_[i * block.record_length];
    const WaveformReference reference = WaveformReference::of(record, layout_);
    if (reference.descriptor == 0 || !reference.direction.allFinite() ||
        reference.direction.isZero(0.0F))
      continue;
    const Eigen::Vector3d steps = (kDisplacementPs * reference.alongPulse()).cwiseQuotient(scale_);
    Eigen::Vector3d moved;
    for (int axis = 0; axis < 3; ++axis)
      moved[axis] = std::round(LasRecordLayout::coordinateOf(record, axis) + steps[axis]);
    if (!fits(moved.x()) || !fits(moved.y()) || !fits(moved.z())) continue;
    for (int axis = 0; axis < 3; ++axis)
      LasRecordLayout::storeCoordinate(static_cast<std::int32_t>(moved[axis]), axis, record);
    displaced_[i] = true;
  }
}

void DisplacedPoints::storeDirections(const LasRecordBlock& block) const {
  if (!any()) return;
  for (std::size_t i = 0; i < block.count; ++i) {
    const std::size_t at = i * block.record_length;
    std::byte* record = block.records + at;
    const std::byte* given = &before_[at];
    if (!displaced_[i] || std::memcmp(record, given, kCoordinateBytes) == 0) continue;
    WaveformReference reference = WaveformReference::of(record, layout_);
    const Eigen::Vector3d old_along = reference.alongPulse();
    // The change of the difference between both points, which rounding of the second one leaves
    // out.
    Eigen::Vector3d change;
    for (int axis = 0; axis < 3; ++axis) {
      const auto moved = [&](const std::byte* to, std::int64_t from) {
        return static_cast<double>(LasRecordLayout::coordinateOf(to, axis) - from);
      };
      const std::int64_t first = LasRecordLayout::coordinateOf(given, axis);
      const auto second = first + std::llround(kDisplacementPs * old_along[axis] / scale_[axis]);
      change[axis] = (moved(&records_[at], second) - moved(record, first)) * scale_[axis];
    }
    const bool towards_anchor = reference.direction.z() > 0.0F;
    const Eigen::Vector3d along = old_along + change / kDisplacementPs;
    reference.direction = (towards_anchor ? Eigen::Vector3d(-along) : along).cast<float>();
    reference.store(record, layout_);
  }
}

}  // namespace pcl_als::detail
