// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/tin/patch_surface.h>
#include <pcl_als/tin/surface_criterion.h>

#include "triangle_distance.h"

namespace pcl_als {
namespace {

using Eigen::Vector3d;

/// The vertices joined to one corner of a triangle by an edge; true if the corner is on the hull.
bool collectRing(const Tin& tin, std::int32_t triangle, int corner,
                 std::vector<std::int32_t>& ring) {
  const std::int32_t centre = tin.triangles()[triangle].vertex[corner];
  // Counter-clockwise until the ring closes; if the hull interrupts it, clockwise from the start.
  for (const int turn : {1, 2}) {
    for (std::int32_t t = triangle;;) {
      const auto& vertex = tin.triangles()[t].vertex;
      const int k = vertex[0] == centre ? 0 : (vertex[1] == centre ? 1 : 2);
      ring.push_back(vertex[(k + 3 - turn) % 3]);
      t = tin.triangles()[t].neighbour[(k + turn) % 3];
      if (t == triangle) return false;
      if (t == Tin::kNone) break;
    }
  }
  return true;
}

/// Leaves of the ring the different vertices that are not the triangle's own.
void keepOthers(const std::array<std::int32_t, 3>& own, std::vector<std::int32_t>& ring) {
  constexpr std::size_t kFew = 48;  // a linear search is faster
  if (ring.size() > kFew) {
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  }
  std::size_t kept = 0;
  for (const std::int32_t v : ring) {
    const auto end = ring.begin() + static_cast<std::ptrdiff_t>(kept);
    const bool repeated = ring.size() <= kFew && std::find(ring.begin(), end, v) != end;
    if (v != own[0] && v != own[1] && v != own[2] && !repeated) ring[kept++] = v;
  }
  ring.resize(kept);
}

/// Sums over points, relative to one of them.
struct Moments {
  double count = 0.0;
  Vector3d sum = Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(const Vector3d& point) {
    count += 1.0;
    sum += point;
    squares.noalias() += point * point.transpose();
  }
};

/// The plane of least squared orthogonal distances.
struct Plane {
  Vector3d normal, centre;
  double rms = 0.0;
  double spread = 0.0;  ///< root of the in-plane scatter along the narrower direction
};

Plane fitPlane(const Moments& moments) {
  const Vector3d mean = moments.sum / moments.count;
  const LeastEigen3 least = leastEigen3(moments.squares - mean * moments.sum.transpose());
  return {least.vector, mean, std::sqrt(std::max(0.0, least.value) / moments.count),
          std::sqrt(std::max(0.0, least.middle_value))};
}

double longestEdge(const Tin& tin, const Tin::Triangle& t) {
  double longest_sq = 0.0;
  for (int i = 0; i < 3; ++i)
    longest_sq =
        std::max(longest_sq,
                 (tin.points()[t.vertex[i]] - tin.points()[t.vertex[(i + 1) % 3]]).squaredNorm());
  return std::sqrt(longest_sq);
}

/// Angle between two lines given by unit vectors; exact for small angles, where acos is not.
double angleBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

}  // namespace

PatchQuality PatchSurface::quality(std::int32_t triangle) const {
  return *examine(triangle, nullptr, 0.0);
}

std::optional<PatchQuality> PatchSurface::suitable(std::int32_t triangle,
                                                   const SurfaceCriterion& criterion,
                                                   double median_edge) const {
  return examine(triangle, &criterion, median_edge);
}

/// With a criterion: empty as soon as it cannot be satisfied.
std::optional<PatchQuality> PatchSurface::examine(std::int32_t triangle,
                                                  const SurfaceCriterion* criterion,
                                                  double median_edge) const {
  PatchQuality quality;
  const Vector3d normal = tin::unitNormal(tin_, triangle);
  quality.longest_edge = static_cast<float>(longestEdge(tin_, tin_.triangles()[triangle]));
  quality.slope = static_cast<float>(std::atan2(normal.head<2>().norm(), normal.z()));
  if (criterion != nullptr && quality.slope > criterion->slope) return std::nullopt;
  thread_local std::vector<std::int32_t> ring;
  ring.clear();
  for (int corner = 0; corner < 3; ++corner)
    quality.on_hull = collectRing(tin_, triangle, corner, ring) || quality.on_hull;
  const auto& own = tin_.triangles()[triangle].vertex;
  const Vector3d& origin = tin_.points()[own[0]];
  Moments others;
  keepOthers(own, ring);
  for (const std::int32_t v : ring) others.add(tin_.points()[v] - origin);
  Moments all = others;
  for (const std::int32_t v : own) all.add(tin_.points()[v] - origin);
  constexpr double kMaximumStored = std::numeric_limits<std::uint16_t>::max();
  quality.vertices = static_cast<std::uint16_t>(std::min(all.count, kMaximumStored));
  if (criterion != nullptr && !criterion->isSound(quality, median_edge)) return std::nullopt;

  const Plane plane = fitPlane(all);
  quality.roughness = static_cast<float>(plane.rms);
  quality.bend = static_cast<float>(angleBetween(normal, plane.normal));
  if (criterion != nullptr && !criterion->isSatisfiedBy(quality, median_edge)) return std::nullopt;

  constexpr double kMinimumNeighbours = 4.0;
  const Plane without_own = others.count >= kMinimumNeighbours ? fitPlane(others) : plane;
  quality.spread = static_cast<float>(without_own.spread);
  quality.plane_normal =
      without_own.normal.z() < 0.0 ? Vector3d(-without_own.normal) : without_own.normal;
  quality.plane_centre = origin + without_own.centre;
  return quality;
}

}  // namespace pcl_als
