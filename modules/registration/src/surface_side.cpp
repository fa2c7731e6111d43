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
constexpr std::size_t kEdgeSamples = 3000;
constexpr double kMargin = 0.1;  // median edges: movement of a point without a new search

}  // namespace

SurfaceSide::SurfaceSide(std::vector<Eigen::Vector3d> points, const Eigen::AlignedBox2d& box,
                         double resolution)
    : surface_(Tin(std::move(points), resolution)), box_(box) {
  median_edge_ = typicalPlanEdge(surface_.tin(), kEdgeSamples);
}

PatchPlane SurfaceSide::planeOf(const PatchQuality& quality) const {
  return {quality.plane_normal, choice_.criterion.tiltStd(quality)};
}

void SurfaceSide::sampleRoughness(std::size_t count, std::vector<double>& values) const {
  const auto& triangles = surface_.tin().triangles();
  const std::size_t step = 1 + triangles.size() / count;
  for (std::size_t t = 0; t < triangles.size(); t += step) {
    const Eigen::Vector3d& corner = surface_.tin().points()[triangles[t].vertex[0]];
    if (!box_.contains(corner.head<2>())) continue;
    const auto quality =
        surface_.suitable(static_cast<std::int32_t>(t), choice_.criterion, median_edge_);
    if (quality && quality->slope < kGentleSlope) values.push_back(quality->roughness);
  }
}

void SurfaceSide::chooseCandidates(std::size_t count, const SurfaceCriterion& criterion) {
  choice_ = {criterion, {}, {}, {}};
  choice_.verdicts.assign(surface_.tin().triangles().size(), kUnknown);
  // The normals of single triangles are noisy and only select triangles that are examined; the
  // orientation is that of the neighbourhood's plane.
  constexpr std::size_t kExaminedPerCandidate = 2, kExaminedTriangles = 16;
  const Tin& tin = surface_.tin();
  const std::size_t step =
      std::max<std::size_t>(1, tin.triangles().size() / (kExaminedTriangles * count));
  const auto rough = trianglesByOrientation(surface_, step, [&](std::int32_t point) {
    return box_.contains(tin.points()[point].head<2>());
  });
  std::vector<std::vector<Candidate>> classes(OrientationClasses::kCount);
  for (const std::int32_t triangle : chosenEvenly(rough, kExaminedPerCandidate * count)) {
    PatchPlane plane;
    if (!planeOf(triangle, plane)) continue;
    const std::int32_t point = tin.triangles()[triangle].vertex[0];
    classes[OrientationClasses::of(plane.normal)].push_back({tin.points()[point], plane});
  }
  choice_.candidates = chosenEvenly(classes, count);
}

void SurfaceSide::makeCoarse(std::size_t count) {
  coarse_ = true;
  choice_.criterion.edge_factor = kCoarseEdges;
  const auto& points = surface_.tin().points();
  const std::size_t step = 1 + points.size() / count;
  for (std::size_t i = 0; i < points.size(); i += step)
    choice_.candidates.push_back({points[i], {}});
}

std::optional<PatchMatch> SurfaceSide::patchOf(Candidate& candidate, const Eigen::Vector3d& moved,
                                               double threshold) {
  auto match = surface_.closest(moved, threshold, kMargin * median_edge_, candidate.patch);
  if (!match) return match;
  if (candidate.judged != match->triangle) {
    candidate.judged = match->triangle;
    candidate.suitable = planeOf(match->triangle, candidate.patch_plane);
    candidate.tilt_sigma = std::hypot(candidate.plane.tilt_sigma, candidate.patch_plane.tilt_sigma);
  }
  if (!candidate.suitable) match.reset();
  return match;
}

bool SurfaceSide::planeOf(std::int32_t triangle, PatchPlane& plane) {
  if (coarse_) return judgeCoarse(triangle, plane);
  std::int32_t& verdict = choice_.verdicts[triangle];
  if (verdict == kUnknown) {
    verdict = judge(triangle, plane) ? static_cast<std::int32_t>(choice_.planes.size()) : kUnfit;
    if (verdict != kUnfit) choice_.planes.push_back(plane);
  }
  if (verdict == kUnfit) return false;
  plane = choice_.planes[verdict];
  return true;
}

bool SurfaceSide::judge(std::int32_t triangle, PatchPlane& plane) const {
  const auto quality = surface_.suitable(triangle, choice_.criterion, median_edge_);
  if (quality) plane = planeOf(*quality);
  return quality.has_value();
}

bool SurfaceSide::judgeCoarse(std::int32_t triangle, PatchPlane& plane) const {
  plane = {surface_.normal(triangle), 0.0};
  if (plane.normal.z() < std::cos(choice_.criterion.slope)) return false;
  const Tin::Triangle& t = surface_.tin().triangles()[triangle];
  for (int i = 0; i < 3; ++i) {
    if (t.neighbour[i] == Tin::kNone) return false;
    const Eigen::Vector3d& a = surface_.tin().points()[t.vertex[i]];
    const Eigen::Vector3d& b = surface_.tin().points()[t.vertex[(i + 1) % 3]];
    if ((a - b).head<2>().norm() > choice_.criterion.edge_factor * median_edge_) return false;
  }
  return true;
}

}  // namespace pcl_als::registration
