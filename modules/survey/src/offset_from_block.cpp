// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include <pcl_als/common/zone_difference.h>
#include <pcl_als/survey/offset_from_block.h>

namespace pcl_als {
namespace {

using Eigen::Vector2d;
using Box = Eigen::AlignedBox2d;

constexpr double kFoot = 0.3048;  // metres

Box scaled(const Box& box, double factor) {
  return {factor * box.min(), factor * box.max()};
}

Box moved(const Box& box, const Vector2d& by) {
  return {box.min() + by, box.max() + by};
}

Box exchanged(const Box& box) {
  return {Vector2d(box.min().y(), box.min().x()), Vector2d(box.max().y(), box.max().x())};
}

bool areDegrees(const Box& box) {
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff() <= 360.0;
}

std::string causeOf(const Box& given, const Box& block) {
  if (areDegrees(given) && !areDegrees(block)) return "its coordinates look like degrees";
  const double million =
      1e6 * std::round((block.center().x() - given.center().x()) / 1e6);  // of the zone's number
  const std::vector<std::pair<Box, const char*>> tried = {
      {exchanged(given), "with x and y exchanged"},
      {scaled(given, kFoot), "if they were in feet"},
      {scaled(given, 1.0 / kFoot), "if those of the strips were in feet"},
      {moved(given, {million, 0.0}), "with another number of the zone before the eastings"},
  };
  std::string cause;
  for (const auto& [box, text] : tried) {
    if (!box.intersects(block)) continue;
    if (!cause.empty()) return {};
    cause = std::string("its coordinates would lie within them ") + text;
  }
  if (!cause.empty()) return cause;
  return zoneDifference(given.center(), block.center());
}

}  // namespace

OffsetFromBlock::OffsetFromBlock(const Box& given, const Box& block) {
  if (given.isEmpty() || block.isEmpty()) return;
  distance = given.exteriorDistance(block);
  if (distance > 0.0) cause = causeOf(given, block);
}

std::string OffsetFromBlock::text() const {
  constexpr double kKilometre = 1000.0;
  char size[48];
  if (distance < kKilometre)
    std::snprintf(size, sizeof size, "%.0f m beside the strips", distance);
  else
    std::snprintf(size, sizeof size, "%.1f km beside the strips", distance / kKilometre);
  return cause.empty() ? size : size + ("; " + cause);
}

}  // namespace pcl_als
