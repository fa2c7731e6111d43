// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "delaunay.h"

#include <algorithm>
#include <cstddef>

#include "edge_mesh.h"

namespace pcl_als::tin {
namespace {

/// The extreme vertices of a part; of equally extreme ones the lowest or leftmost, which is a
/// corner of its hull and so has a unique hull edge.
struct Extremes {
  Vertex west, east, south, north;
};

/// Builds the edges of the triangulation of vertices that are numbered in Morton order.
class DivideAndConquer {
 public:
  DivideAndConquer(const std::vector<std::uint64_t>& code, std::vector<PlanPoint> plan)
      : code_(code), p_(std::move(plan)), mesh_(p_.size()), hull_(p_.size(), kNoEdge) {}

  void run() { extremes_ = build(0, static_cast<Vertex>(p_.size())); }
  EdgeMesh& mesh() { return mesh_; }
  /// An edge of the hull, counter-clockwise.
  Edge hullEdge() const { return hull_[extremes_.west]; }

 private:
  Extremes build(Vertex first, Vertex last);
  Extremes single(Vertex v) { return {v, v, v, v}; }
  Extremes pair(Vertex a);
  Extremes merge(const Extremes& low, const Extremes& high, bool cut_in_y);
  void zip(Vertex u, Vertex v);
  Edge lowerTangent(Vertex& u, Vertex& v);
  Edge leftCandidate(Edge base, Vertex u, Vertex v);
  Edge rightCandidate(Edge base, Vertex u, Vertex v);

  const std::vector<std::uint64_t>& code_;
  std::vector<PlanPoint> p_;
  EdgeMesh mesh_;
  std::vector<Edge> hull_;  ///< hull edge that leaves a vertex counter-clockwise; valid at corners
  Extremes extremes_{};
};

Extremes DivideAndConquer::build(Vertex first, Vertex last) {
  if (last - first == 1) return single(first);
  if (last - first == 2) return pair(first);
  const std::uint64_t difference = code_[first] ^ code_[last - 1];
  const int bit = 63 - __builtin_clzll(difference);
  const std::uint64_t cut = (code_[last - 1] >> bit) << bit;
  const auto begin = code_.begin();
  const auto middle =
      static_cast<Vertex>(std::lower_bound(begin + first, begin + last, cut) - begin);
  const Extremes low = build(first, middle);
  return merge(low, build(middle, last), (bit & 1) != 0);
}

/// Two vertices, joined by an edge.
Extremes DivideAndConquer::pair(Vertex a) {
  const Vertex b = a + 1;
  const Edge e = mesh_.add(a, b);
  mesh_.startRing(e);
  mesh_.startRing(twin(e));
  hull_[a] = e, hull_[b] = twin(e);
  const bool a_west = p_[a].x != p_[b].x ? p_[a].x < p_[b].x : p_[a].y < p_[b].y;
  const bool a_east = p_[a].x != p_[b].x ? p_[a].x > p_[b].x : p_[a].y < p_[b].y;
  const bool a_south = p_[a].y != p_[b].y ? p_[a].y < p_[b].y : p_[a].x < p_[b].x;
  const bool a_north = p_[a].y != p_[b].y ? p_[a].y > p_[b].y : p_[a].x < p_[b].x;
  return {a_west ? a : b, a_east ? a : b, a_south ? a : b, a_north ? a : b};
}

Extremes DivideAndConquer::merge(const Extremes& low, const Extremes& high, bool cut_in_y) {
  Extremes merged{};
  if (cut_in_y) {  // turned by a right angle, south is left and north is right
    zip(low.north, high.south);
    merged = {p_[high.west].x < p_[low.west].x ? high.west : low.west,
              p_[high.east].x > p_[low.east].x ? high.east : low.east, low.south, high.north};
  } else {
    zip(low.east, high.west);
    merged = {low.west, high.east, p_[high.south].y < p_[low.south].y ? high.south : low.south,
              p_[high.north].y > p_[low.north].y ? high.north : low.north};
  }
  return merged;
}

/// Walks u (on the left hull) and v (on the right hull) down to their common tangent and joins
/// them.
Edge DivideAndConquer::lowerTangent(Vertex& u, Vertex& v) {
  Edge eu = hull_[u], ev = hull_[v];
  for (;;) {
    if (eu != kNoEdge) {
      const Edge clockwise = mesh_.previous(eu);
      const Vertex w = mesh_.destination(clockwise);
      if (orientation(p_[u], p_[v], p_[w]) < 0) {
        u = w, eu = twin(clockwise);
        continue;
      }
    }
    if (ev == kNoEdge) break;
    const Vertex w = mesh_.destination(ev);
    if (orientation(p_[u], p_[v], p_[w]) >= 0) break;
    v = w, ev = mesh_.next(twin(ev));
  }
  const Edge base = mesh_.add(u, v);
  eu == kNoEdge ? mesh_.startRing(base) : mesh_.insertBefore(base, eu);
  ev == kNoEdge ? mesh_.startRing(twin(base)) : mesh_.insertBefore(twin(base), ev);
  hull_[u] = base;
  return base;
}

/// The edge from u into the left part that would close the next triangle above u-v; edges of the
/// left part that v invalidates are removed on the way.
Edge DivideAndConquer::leftCandidate(Edge base, Vertex u, Vertex v) {
  Edge candidate = mesh_.next(base);
  if (candidate == base) return kNoEdge;
  Vertex w = mesh_.destination(candidate);
  if (orientation(p_[u], p_[v], p_[w]) <= 0) return kNoEdge;
  for (;;) {
    const Edge after = mesh_.next(candidate);
    if (after == base) return candidate;
    const Vertex x = mesh_.destination(after);
    if (!inCircle(p_[u], p_[v], p_[w], p_[x])) return candidate;
    mesh_.remove(candidate);
    candidate = after, w = x;
  }
}

Edge DivideAndConquer::rightCandidate(Edge base, Vertex u, Vertex v) {
  const Edge down = twin(base);
  Edge candidate = mesh_.previous(down);
  if (candidate == down) return kNoEdge;
  Vertex w = mesh_.destination(candidate);
  if (orientation(p_[u], p_[v], p_[w]) <= 0) return kNoEdge;
  for (;;) {
    const Edge after = mesh_.previous(candidate);
    if (after == down) return candidate;
    const Vertex x = mesh_.destination(after);
    if (!inCircle(p_[u], p_[v], p_[w], p_[x])) return candidate;
    mesh_.remove(candidate);
    candidate = after, w = x;
  }
}

/// Joins a left and a right part from their lower to their upper common tangent.
void DivideAndConquer::zip(Vertex u, Vertex v) {
  Edge base = lowerTangent(u, v);
  for (;;) {
    const Edge left = leftCandidate(base, u, v);
    const Edge right = rightCandidate(base, u, v);
    if (left == kNoEdge && right == kNoEdge) break;
    const Vertex lw = left == kNoEdge ? kNoEdge : mesh_.destination(left);
    const Vertex rw = right == kNoEdge ? kNoEdge : mesh_.destination(right);
    if (left == kNoEdge || (right != kNoEdge && inCircle(p_[u], p_[v], p_[lw], p_[rw]))) {
      const Edge next = mesh_.add(u, rw);
      mesh_.insertAfter(next, base);
      mesh_.insertBefore(twin(next), twin(right));
      base = next, v = rw;
    } else {
      const Edge next = mesh_.add(lw, v);
      mesh_.insertAfter(next, twin(left));
      mesh_.insertBefore(twin(next), twin(base));
      base = next, u = lw;
    }
  }
  hull_[v] = twin(base);
}

std::vector<PlanPoint> planPoints(const SpatialOrder& order) {
  std::vector<PlanPoint> plan(order.code.size());
  std::transform(order.code.begin(), order.code.end(), plan.begin(), planPointOf);
  return plan;
}

}  // namespace

std::vector<Tin::Triangle> delaunayTriangles(const SpatialOrder& order) {
  if (order.code.size() < 3) return {};
  DivideAndConquer builder(order.code, planPoints(order));
  builder.run();
  std::vector<Tin::Triangle> triangles =
      trianglesOf(builder.mesh(), twin(builder.hullEdge()), order.code.size());
  for (Tin::Triangle& t : triangles)
    for (std::int32_t& v : t.vertex) v = order.point[v];
  return triangles;
}

}  // namespace pcl_als::tin
