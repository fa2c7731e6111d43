// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/tin/patch_surface.h>

#include "closest_search.h"
#include "exact_orientation.h"
#include "triangle_distance.h"

namespace pcl_als {
namespace {

PatchMatch matchOf(const Tin& tin, std::int32_t triangle, const Eigen::Vector3d& area_normal,
                   const Eigen::Vector3d& point) {
  PatchMatch match;
  match.triangle = triangle;
  match.normal = tin::unitUpward(area_normal);
  const Eigen::Vector3d& a = tin.points()[tin.triangles()[triangle].vertex[0]];
  match.signed_normal_distance = match.normal.dot(point - a);
  match.foot = point - match.signed_normal_distance * match.normal;
  return match;
}

std::optional<PatchMatch> matchOf(const Tin& tin, std::int32_t triangle,
                                  const tin::TriangleDistance& distance,
                                  const Eigen::Vector3d& point) {
  if (triangle == Tin::kNone || !distance.inside) return std::nullopt;
  PatchMatch match = matchOf(tin, triangle, distance.normal, point);
  match.weights = distance.weights;
  return match;
}

void checkDistance(double max_normal_distance) {
  if (!(max_normal_distance > 0.0))
    throw UsageError("PatchSurface: max_normal_distance must be a positive number of metres, not " +
                     std::to_string(max_normal_distance));
}

/// How far a point may move without a change of the closest triangle: both distances change by no
/// more than that.
double freeMovement(const tin::Closest& found, double max_distance) {
  constexpr double kRounding = 1e-9;  // metres
  if (found.triangle == Tin::kNone) return found.others - max_distance - kRounding;
  return 0.5 * (found.others - std::sqrt(found.distance.distance_sq)) - kRounding;
}

}  // namespace

PatchSurface::PatchSurface(Tin tin) : tin_(std::move(tin)) {}

Eigen::Vector3d PatchSurface::normal(std::int32_t triangle) const {
  return tin::unitNormal(tin_, triangle);
}

std::optional<PatchMatch> PatchSurface::closest(const Eigen::Vector3d& point,
                                                double max_normal_distance) const {
  std::int32_t hint = Tin::kNone;
  return closest(point, max_normal_distance, hint);
}

std::optional<PatchMatch> PatchSurface::closest(const Eigen::Vector3d& point,
                                                double max_normal_distance,
                                                std::int32_t& hint) const {
  checkDistance(max_normal_distance);
  if (!point.allFinite()) return std::nullopt;
  const tin::Closest found = tin::closestTriangle(tin_, point, max_normal_distance, 0.0, hint);
  return matchOf(tin_, found.triangle, found.distance, point);
}

std::optional<PatchMatch> PatchSurface::closest(const Eigen::Vector3d& point,
                                                double max_normal_distance, double margin,
                                                PatchSearch& last) const {
  checkDistance(max_normal_distance);
  if (!point.allFinite()) return std::nullopt;
  const double moved = (point - last.point).norm();
  if (moved < last.movement &&
      (last.triangle != Tin::kNone || max_normal_distance <= last.within)) {
    if (last.triangle == Tin::kNone) return std::nullopt;
    const tin::TriangleDistance distance = tin::triangleDistance(tin_, last.triangle, point);
    if (distance.distance_sq > max_normal_distance * max_normal_distance) return std::nullopt;
    return matchOf(tin_, last.triangle, distance, point);
  }
  // Twice the movement, by which two distances may approach each other. After a larger movement the
  // next one is mostly large, too, and other triangles would be looked at in vain.
  const double extra = moved < margin ? 2.0 * margin : 0.0;
  const tin::Closest found =
      tin::closestTriangle(tin_, point, max_normal_distance, extra, last.under);
  last = {last.under, found.triangle, point, max_normal_distance,
          freeMovement(found, max_normal_distance)};
  return matchOf(tin_, found.triangle, found.distance, point);
}

std::optional<PatchMatch> PatchSurface::vertical(const Eigen::Vector3d& point) const {
  if (!point.allFinite()) return std::nullopt;
  const std::int32_t triangle = tin_.locate(point.x(), point.y());
  if (triangle == Tin::kNone) return std::nullopt;
  PatchMatch match = matchOf(tin_, triangle, tin::areaNormal(tin_, triangle), point);
  const auto& vertex = tin_.triangles()[triangle].vertex;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = tin_.points()[vertex[(i + 1) % 3]];
    const Eigen::Vector3d& b = tin_.points()[vertex[(i + 2) % 3]];
    match.weights[i] = tin::orientation(a.x(), a.y(), b.x(), b.y(), point.x(), point.y());
  }
  match.weights /= match.weights.sum();
  return match;
}

void PatchSurface::movePoints(std::vector<Eigen::Vector3d> points) {
  tin_.movePoints(std::move(points));
}

}  // namespace pcl_als
