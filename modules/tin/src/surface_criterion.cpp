// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/statistics.h>
#include <pcl_als/tin/orientation_classes.h>
#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als {
namespace {

/// 90th percentile of the longest edges of the triangles over the median edge: measured 1.2 to 2.0
/// for scan lines, cones and independent points, 2.1 to 4.7 for a rosette.
constexpr double kClusteredEdges = 2.3;

}  // namespace

bool SurfaceCriterion::isSound(const PatchQuality& quality, double median_edge) const {
  return !(reject_border && quality.on_hull) && quality.longest_edge <= edge_length &&
         quality.longest_edge <=
             edge_factor * median_edge / std::max(0.3F, std::cos(quality.slope)) &&
         quality.vertices >= minimum_vertices;
}

bool SurfaceCriterion::isSatisfiedBy(const PatchQuality& quality, double median_edge) const {
  return quality.slope <= slope && quality.roughness <= roughness && quality.bend <= bend &&
         isSound(quality, median_edge);
}

double SurfaceCriterion::tiltStd(const PatchQuality& quality) const {
  return std::max<double>(quality.roughness, plain_roughness) /
         std::max<double>(quality.spread, 1e-3);
}

double typicalPlanEdge(const Tin& tin, std::size_t triangles) {
  std::vector<double> lengths, longest;
  const auto& all = tin.triangles();
  const std::size_t step = 1 + (triangles == 0 ? 0 : all.size() / triangles);
  lengths.reserve(3 * all.size() / step + 3);
  longest.reserve(all.size() / step + 1);
  for (std::size_t t = 0; t < all.size(); t += step) {
    longest.push_back(0.0);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d edge =
          tin.points()[all[t].vertex[i]] - tin.points()[all[t].vertex[(i + 1) % 3]];
      lengths.push_back(edge.head<2>().norm());
      longest.back() = std::max(longest.back(), lengths.back());
    }
  }
  if (lengths.empty()) return 0.0;
  const auto tenth = longest.begin() + static_cast<std::ptrdiff_t>(longest.size() * 9 / 10);
  std::nth_element(longest.begin(), tenth, longest.end());
  return std::max(medianInPlace(lengths), *tenth / kClusteredEdges);
}

std::vector<std::vector<std::int32_t>> trianglesByOrientation(
    const PatchSurface& surface, std::size_t step,
    const std::function<bool(std::int32_t vertex)>& wanted) {
  std::vector<std::vector<std::int32_t>> classes(OrientationClasses::kCount);
  const auto& triangles = surface.tin().triangles();
  std::vector<bool> seen(surface.tin().points().size(), false);
  for (std::size_t t = 0; t < triangles.size(); t += step) {
    const std::int32_t point = triangles[t].vertex[0];
    if (seen[point] || !wanted(point)) continue;
    seen[point] = true;
    const std::int32_t beyond = triangles[t].neighbour[0];
    if (beyond == Tin::kNone) continue;
    classes[OrientationClasses::of(surface.normal(beyond))].push_back(static_cast<std::int32_t>(t));
  }
  return classes;
}

}  // namespace pcl_als
