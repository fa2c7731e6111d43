// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/tin/patch_surface.h>

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

/// The plane of least squared orthogonal distances.
struct Plane {
  Vector3d normal, centre;
  double rms = 0.0;
  double spread = 0.0;  ///< root of the in-plane scatter along the narrower direction
};

Plane fitPlane(const Tin& tin, const std::vector<std::int32_t>& vertices) {
  const Vector3d& origin = tin.points()[vertices.front()];
  Vector3d mean = Vector3d::Zero();
  for (const std::int32_t v : vertices) mean += tin.points()[v] - origin;
  mean /= static_cast<double>(vertices.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const std::int32_t v : vertices) {
    const Vector3d d = tin.points()[v] - origin - mean;
    scatter.noalias() += d * d.transpose();
  }
  const SymmetricEigen<3> eigen = symmetricEigen3(scatter);
  Plane plane{eigen.vectors.col(0), origin + mean, 0.0, std::sqrt(std::max(0.0, eigen.values[1]))};
  double sum = 0.0;
  for (const std::int32_t v : vertices) {
    const double distance = plane.normal.dot(tin.points()[v] - origin - mean);
    sum += distance * distance;
  }
  plane.rms = std::sqrt(sum / static_cast<double>(vertices.size()));
  return plane;
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
  PatchQuality quality;
  std::vector<std::int32_t> ring;
  ring.reserve(64);
  for (int corner = 0; corner < 3; ++corner)
    quality.on_hull = collectRing(tin_, triangle, corner, ring) || quality.on_hull;
  std::sort(ring.begin(), ring.end());
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  constexpr std::size_t kMost = std::numeric_limits<std::uint16_t>::max();
  quality.vertices = static_cast<std::uint16_t>(std::min(ring.size(), kMost));

  const Vector3d normal = tin::unitNormal(tin_, triangle);
  const Plane plane = fitPlane(tin_, ring);
  quality.longest_edge = static_cast<float>(longestEdge(tin_, tin_.triangles()[triangle]));
  quality.slope = static_cast<float>(std::atan2(normal.head<2>().norm(), normal.z()));
  quality.roughness = static_cast<float>(plane.rms);
  quality.bend = static_cast<float>(angleBetween(normal, plane.normal));

  const auto& own = tin_.triangles()[triangle].vertex;
  const auto isOwn = [&own](std::int32_t v) { return v == own[0] || v == own[1] || v == own[2]; };
  ring.erase(std::remove_if(ring.begin(), ring.end(), isOwn), ring.end());
  constexpr std::size_t kEnough = 4;
  const Plane around = ring.size() >= kEnough ? fitPlane(tin_, ring) : plane;
  quality.spread = static_cast<float>(around.spread);
  quality.plane_normal = around.normal.z() < 0.0 ? Vector3d(-around.normal) : around.normal;
  quality.plane_centre = around.centre;
  return quality;
}

}  // namespace pcl_als
