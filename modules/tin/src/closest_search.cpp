// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "closest_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_als::tin {
namespace {

using Eigen::Vector3d;

/// Plan distances are compared with this much to spare (metres), so that their rounding cannot cut
/// off a triangle.
constexpr double kSlack = 1e-6;

/// Puts a triangle in its slot of an open-addressing table with room to spare.
bool place(std::int32_t* table, std::size_t capacity, std::size_t hash, std::int32_t triangle) {
  for (std::size_t slot = (hash >> 7) & (capacity - 1);; slot = (slot + 1) & (capacity - 1)) {
    if (table[slot] == triangle) return false;
    if (table[slot] != Tin::kNone) continue;
    table[slot] = triangle;
    return true;
  }
}

/// A hull edge: the triangle it belongs to and the corner opposite.
struct HullEdge {
  std::int32_t triangle;
  int opposite;
};

/// The hull edge after (turn = 1) or before (turn = 2) another one, counter-clockwise.
HullEdge besideOnHull(const Tin& tin, HullEdge at, int turn) {
  // Around the vertex that both share, through the triangles of its fan.
  const std::int32_t shared = tin.triangles()[at.triangle].vertex[(at.opposite + 3 - turn) % 3];
  std::int32_t t = at.triangle;
  for (;;) {
    const auto& vertex = tin.triangles()[t].vertex;
    const auto k =
        static_cast<int>(std::find(vertex.begin(), vertex.end(), shared) - vertex.begin());
    const int across = (k + 3 - turn) % 3;
    const std::int32_t next = tin.triangles()[t].neighbour[across];
    if (next == Tin::kNone) return {t, across};
    t = next;
  }
}

/// -1, 0, 1: a position lies before, beside or after a hull edge, counter-clockwise.
int sideAlong(const Tin& tin, HullEdge at, const Vector3d& point) {
  const auto& vertex = tin.triangles()[at.triangle].vertex;
  const Eigen::Vector2d a = tin.points()[vertex[(at.opposite + 1) % 3]].head<2>();
  const Eigen::Vector2d b = tin.points()[vertex[(at.opposite + 2) % 3]].head<2>();
  const double along = (point.head<2>() - a).dot(b - a);
  if (along < 0.0) return -1;
  return along > (b - a).squaredNorm() ? 1 : 0;
}

/// From a hull triangle that sees a position outside, along the hull to the one closest in plan.
/// The hull is convex: a side once taken is not left.
std::int32_t closestOnHull(const Tin& tin, std::int32_t triangle, const Vector3d& point) {
  const auto& t = tin.triangles()[triangle];
  HullEdge at{triangle, -1};
  for (int i = 0; i < 3; ++i) {
    if (t.neighbour[i] != Tin::kNone) continue;
    const Vector3d &a = tin.points()[t.vertex[(i + 1) % 3]],
                   &b = tin.points()[t.vertex[(i + 2) % 3]];
    at.opposite = i;
    if ((b - a).head<2>().dot(Eigen::Vector2d(point.y() - a.y(), a.x() - point.x())) > 0.0) break;
  }
  // Points that were moved may leave a position in no triangle though it is inside: no hull to
  // follow.
  if (at.opposite < 0) return triangle;
  const int side = sideAlong(tin, at, point);
  for (std::size_t steps = tin.triangles().size(); steps > 0; --steps) {
    if (side == 0 || sideAlong(tin, at, point) != side) break;
    const HullEdge beside = besideOnHull(tin, at, side > 0 ? 1 : 2);
    if (sideAlong(tin, beside, point) == -side) break;  // the vertex between is closest
    at = beside;
  }
  return at.triangle;
}

}  // namespace

bool TriangleSet::insert(std::int32_t triangle) {
  if (size_ == kSmall && spilled_.empty()) spill();
  if (spilled_.empty()) {
    if (!place(table_.data(), table_.size(), hash(triangle), triangle)) return false;
    order_[size_++] = triangle;
    return true;
  }
  if (2 * size_ >= spilled_table_.size()) spill();
  if (!place(spilled_table_.data(), spilled_table_.size(), hash(triangle), triangle)) return false;
  spilled_.push_back(triangle);
  ++size_;
  return true;
}

/// Moves to, or enlarges, the table on the heap.
void TriangleSet::spill() {
  if (spilled_.empty()) spilled_.assign(order_.begin(), order_.end());
  spilled_table_.assign(8 * size_, Tin::kNone);
  for (const std::int32_t t : spilled_)
    place(spilled_table_.data(), spilled_table_.size(), hash(t), t);
}

/** Every triangle within a 3D distance d of the point has a part within the plan distance d. The
 * triangles that touch a disc around the point hang together through edges that touch it, as the
 * hull is convex. So: from a triangle inside the disc, across edges inside the disc, while the disc
 * shrinks to the best distance so far. */
Closest closestTriangle(const Tin& tin, const Vector3d& point, double max_distance, double margin,
                        std::int32_t& hint) {
  Closest best;
  const Tin::Location under = tin.walk(point.x(), point.y(), hint);
  hint = under.triangle;
  if (under.triangle == Tin::kNone) return best;
  best.distance.distance_sq = max_distance * max_distance;
  const double more = margin + kSlack;
  double plan_sq = (max_distance + more) * (max_distance + more);
  double others_sq = std::numeric_limits<double>::infinity();
  TriangleSet reached;
  reached.insert(under.inside ? under.triangle : closestOnHull(tin, under.triangle, point));
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const std::int32_t at = reached[i];
    const TriangleDistance distance = triangleDistance(tin, at, point);
    const double gain = best.distance.distance_sq - distance.distance_sq;
    if (gain > 0.0 || (gain == 0.0 && (best.triangle == Tin::kNone || at < best.triangle))) {
      if (best.triangle != Tin::kNone) others_sq = std::min(others_sq, best.distance.distance_sq);
      best = {at, distance};
      const double radius = std::sqrt(distance.distance_sq) + more;
      plan_sq = radius * radius;
    } else {
      others_sq = std::min(others_sq, distance.distance_sq);
    }
    const Tin::Triangle& t = tin.triangles()[at];
    for (int k = 0; k < 3; ++k) {
      if (t.neighbour[k] == Tin::kNone) continue;
      const Vector3d& a = tin.points()[t.vertex[(k + 1) % 3]];
      if (segmentWithin(a, tin.points()[t.vertex[(k + 2) % 3]], point, plan_sq))
        reached.insert(t.neighbour[k]);
    }
  }
  best.others = std::sqrt(std::min(others_sq, plan_sq)) - kSlack;
  return best;
}

}  // namespace pcl_als::tin
