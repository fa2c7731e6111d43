// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_als::tin {
namespace {

using Eigen::Vector3d;

/// A projection this little outside counts as on the edge; rounding of weights is far below.
constexpr double kOnEdge = -1e-12;

double segmentDistanceSq(const Vector3d& a, const Vector3d& b, const Vector3d& point) {
  const Vector3d ab = b - a, ap = point - a;
  const double along = ap.dot(ab), length_sq = ab.squaredNorm();
  if (along <= 0.0) return ap.squaredNorm();
  if (along >= length_sq) return (point - b).squaredNorm();
  return (ap - ab * (along / length_sq)).squaredNorm();
}

/// The smallest distance to the edges on whose outer side the projection lies.
double borderDistanceSq(const Tin& tin, const Tin::Triangle& t, const Vector3d& weights,
                        const Vector3d& point) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (weights[i] >= 0.0) continue;
    // In the order of their indices, so both triangles of an edge compute the same.
    const auto [low, high] = std::minmax(t.vertex[(i + 1) % 3], t.vertex[(i + 2) % 3]);
    smallest = std::min(smallest, segmentDistanceSq(tin.points()[low], tin.points()[high], point));
  }
  return smallest;
}

}  // namespace

Vector3d areaNormal(const Tin& tin, std::int32_t triangle) {
  const Tin::Triangle& t = tin.triangles()[triangle];
  const Vector3d& a = tin.points()[t.vertex[0]];
  return (tin.points()[t.vertex[1]] - a).cross(tin.points()[t.vertex[2]] - a);
}

Vector3d unitUpward(const Vector3d& area_normal) {
  const double length = area_normal.norm();
  if (length == 0.0) return Vector3d::UnitZ();
  return area_normal * (std::copysign(1.0, area_normal.z()) / length);
}

Vector3d unitNormal(const Tin& tin, std::int32_t triangle) {
  return unitUpward(areaNormal(tin, triangle));
}

TriangleDistance triangleDistance(const Tin& tin, std::int32_t triangle, const Vector3d& point) {
  const Tin::Triangle& t = tin.triangles()[triangle];
  const Vector3d& a = tin.points()[t.vertex[0]];
  const Vector3d ab = tin.points()[t.vertex[1]] - a, ac = tin.points()[t.vertex[2]] - a;
  const Vector3d ap = point - a, n = ab.cross(ac);
  const double nn = n.squaredNorm();
  TriangleDistance result;
  result.normal = n;
  if (nn == 0.0) {  // moved points can do this; its edges still have a distance
    result.weights.setConstant(-1.0);
  } else {
    const double wb = ap.cross(ac).dot(n) / nn, wc = ab.cross(ap).dot(n) / nn;
    result.weights = Vector3d(1.0 - wb - wc, wb, wc);
    result.inside = result.weights.minCoeff() >= kOnEdge;
  }
  if (result.inside) {
    const double across = n.dot(ap);
    result.distance_sq = across * across / nn;
    result.weights = result.weights.cwiseMax(0.0);
  } else {
    result.distance_sq = borderDistanceSq(tin, t, result.weights, point);
  }
  return result;
}

}  // namespace pcl_als::tin
