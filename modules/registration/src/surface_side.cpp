// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "surface_side.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/statistics.h>
#include <pcl_als/tin/orientation_classes.h>

namespace pcl_als::registration {
namespace {

constexpr std::int32_t kUnknown = -1, kUnfit = -2;
constexpr double kCoarseEdges = 6.0;  // longest edge against the median, TIN of lowest points
constexpr double kGentle = 0.26;      // radians
constexpr int kFewestVertices = 7;    // in a neighbourhood
constexpr std::size_t kEdgeSamples = 3000;

double medianEdge(const Tin& tin) {
  std::vector<double> lengths;
  const auto& triangles = tin.triangles();
  const std::size_t step = 1 + triangles.size() / kEdgeSamples;
  for (std::size_t t = 0; t < triangles.size(); t += step) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = tin.points()[triangles[t].vertex[i]];
      lengths.push_back((a - tin.points()[triangles[t].vertex[(i + 1) % 3]]).head<2>().norm());
    }
  }
  return lengths.empty() ? 0.0 : medianInPlace(lengths);
}

}  // namespace

SurfaceSide::SurfaceSide(std::vector<Eigen::Vector3d> points, const Eigen::AlignedBox2d& box,
                         double resolution)
    : surface_(Tin(std::move(points), resolution)), box_(box) {
  median_edge_ = medianEdge(surface_.tin());
  verdicts_.assign(surface_.tin().triangles().size(), kUnknown);
}

bool SurfaceSide::acceptable(const PatchQuality& quality) const {
  return !quality.on_hull && quality.slope <= limits_.slope &&
         quality.vertices >= kFewestVertices &&
         quality.longest_edge <= limits_.edges * median_edge_ / std::cos(quality.slope) &&
         quality.roughness <= limits_.roughness;
}

PatchPlane SurfaceSide::planeOf(const PatchQuality& quality) const {
  const double noise = std::max<double>(quality.roughness, limits_.plain_roughness);
  return {quality.plane_normal, noise / std::max<double>(quality.spread, 1e-3)};
}

void SurfaceSide::sampleRoughness(std::size_t count, std::vector<double>& values) const {
  const auto& triangles = surface_.tin().triangles();
  const std::size_t step = 1 + triangles.size() / count;
  for (std::size_t t = 0; t < triangles.size(); t += step) {
    const Eigen::Vector3d& corner = surface_.tin().points()[triangles[t].vertex[0]];
    if (!box_.contains(corner.head<2>())) continue;
    const PatchQuality quality = surface_.quality(static_cast<std::int32_t>(t));
    if (acceptable(quality) && quality.slope < kGentle) values.push_back(quality.roughness);
  }
}

std::vector<std::vector<std::int32_t>> SurfaceSide::trianglesByClass(std::size_t step) const {
  std::vector<std::vector<std::int32_t>> classes(OrientationClasses::kCount);
  const Tin& tin = surface_.tin();
  std::vector<bool> seen(tin.points().size(), false);
  for (std::size_t t = 0; t < tin.triangles().size(); t += step) {
    const std::int32_t point = tin.triangles()[t].vertex[0];
    if (seen[point] || !box_.contains(tin.points()[point].head<2>())) continue;
    seen[point] = true;
    // The triangle beyond the opposite edge: points that were looked for because their own noise
    // made them face west would not have a mean error of zero.
    const std::int32_t beyond = tin.triangles()[t].neighbour[0];
    if (beyond == Tin::kNone) continue;
    classes[OrientationClasses::of(surface_.normal(beyond))].push_back(
        static_cast<std::int32_t>(t));
  }
  return classes;
}

void SurfaceSide::chooseCandidates(std::size_t count, const SurfaceLimits& limits) {
  limits_ = limits;
  verdicts_.assign(verdicts_.size(), kUnknown);
  planes_.clear();
  candidates_.clear();
  // A single triangle's normal is noisy: it decides where to look, the neighbourhood's plane what
  // is there.
  constexpr std::size_t kLooks = 2, kEnough = 16;
  const std::size_t step = surface_.tin().triangles().size() / (kEnough * count);
  const auto rough = trianglesByClass(std::max<std::size_t>(1, step));
  std::vector<std::size_t> sizes;
  for (const auto& triangles : rough) sizes.push_back(triangles.size());
  const auto looks = evenShares(sizes, kLooks * count);
  std::vector<std::vector<Candidate>> classes(OrientationClasses::kCount);
  for (std::size_t c = 0; c < rough.size(); ++c) {
    for (std::size_t k = 0; k < looks[c]; ++k) {
      const std::int32_t triangle = rough[c][k * rough[c].size() / looks[c]];
      PatchPlane plane;
      if (!planeOf(triangle, plane)) continue;
      const std::int32_t point = surface_.tin().triangles()[triangle].vertex[0];
      classes[OrientationClasses::of(plane.normal)].push_back(
          {surface_.tin().points()[point], plane});
    }
  }
  for (std::size_t c = 0; c < classes.size(); ++c) sizes[c] = classes[c].size();
  const auto shares = evenShares(sizes, count);
  for (std::size_t c = 0; c < classes.size(); ++c)
    for (std::size_t k = 0; k < shares[c]; ++k)
      candidates_.push_back(classes[c][k * classes[c].size() / shares[c]]);
}

void SurfaceSide::makeCoarse(std::size_t count) {
  coarse_ = true;
  limits_.edges = kCoarseEdges;
  const auto& points = surface_.tin().points();
  const std::size_t step = 1 + points.size() / count;
  for (std::size_t i = 0; i < points.size(); i += step) candidates_.push_back({points[i], {}});
}

bool SurfaceSide::planeOf(std::int32_t triangle, PatchPlane& plane) {
  if (coarse_) return judgeCoarse(triangle, plane);
  std::int32_t& verdict = verdicts_[triangle];
  if (verdict == kUnknown) {
    verdict = judge(triangle, plane) ? static_cast<std::int32_t>(planes_.size()) : kUnfit;
    if (verdict != kUnfit) planes_.push_back(plane);
  }
  if (verdict == kUnfit) return false;
  plane = planes_[verdict];
  return true;
}

bool SurfaceSide::judge(std::int32_t triangle, PatchPlane& plane) const {
  const PatchQuality quality = surface_.quality(triangle);
  plane = planeOf(quality);
  return acceptable(quality);
}

bool SurfaceSide::judgeCoarse(std::int32_t triangle, PatchPlane& plane) const {
  plane = {surface_.normal(triangle), 0.0};
  if (plane.normal.z() < std::cos(limits_.slope)) return false;
  const Tin::Triangle& t = surface_.tin().triangles()[triangle];
  for (int i = 0; i < 3; ++i) {
    if (t.neighbour[i] == Tin::kNone) return false;
    const Eigen::Vector3d& a = surface_.tin().points()[t.vertex[i]];
    const Eigen::Vector3d& b = surface_.tin().points()[t.vertex[(i + 1) % 3]];
    if ((a - b).head<2>().norm() > limits_.edges * median_edge_) return false;
  }
  return true;
}

}  // namespace pcl_als::registration
