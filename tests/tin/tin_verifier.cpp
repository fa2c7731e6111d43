// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "tin_verifier.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pcl_als::test {
namespace {

std::string problem(const std::string& what, std::size_t triangle) {
  return what + " at triangle " + std::to_string(triangle);
}

/// Twice the area of the convex hull (monotone chain).
Int128 doubledHullArea(std::vector<LatticePoint> points) {
  std::sort(points.begin(), points.end());
  std::vector<LatticePoint> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const LatticePoint& p : points) {
      while (hull.size() >= start + 2 && doubledArea(hull[hull.size() - 2], hull.back(), p) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  Int128 area = 0;
  for (std::size_t i = 2; i < hull.size(); ++i) area += doubledArea(hull[0], hull[i - 1], hull[i]);
  return area;
}

std::string verifyNeighbours(const Tin& tin) {
  const auto& triangles = tin.triangles();
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> owner;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto& v = triangles[t].vertex;
      if (!owner.emplace(std::make_pair(v[(i + 1) % 3], v[(i + 2) % 3]), t).second)
        return problem("directed edge used twice", t);
    }
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto& v = triangles[t].vertex;
      const auto across = owner.find({v[(i + 2) % 3], v[(i + 1) % 3]});
      const std::int32_t expected =
          across == owner.end() ? Tin::kNone : static_cast<std::int32_t>(across->second);
      if (triangles[t].neighbour[i] != expected) return problem("wrong neighbour", t);
    }
  return {};
}

std::string verifyVertices(const Tin& tin, const std::vector<LatticePoint>& lattice) {
  std::map<LatticePoint, std::int32_t> first;
  for (std::size_t i = 0; i < lattice.size(); ++i)
    first.emplace(lattice[i], static_cast<std::int32_t>(i));
  if (tin.mergedPoints() != lattice.size() - first.size()) return "wrong count of merged points";
  std::set<std::int32_t> used;
  std::size_t hull_edges = 0;
  for (std::size_t t = 0; t < tin.triangles().size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t v = tin.triangles()[t].vertex[i];
      if (v < 0 || v >= static_cast<std::int32_t>(lattice.size()))
        return problem("no such point", t);
      if (first.at(lattice[v]) != v) return problem("not the first point on its position", t);
      used.insert(v);
      hull_edges += tin.triangles()[t].neighbour[i] == Tin::kNone ? 1 : 0;
    }
  if (tin.triangles().empty()) return {};
  if (used.size() != first.size()) return "a position is in no triangle";
  if (tin.triangles().size() + hull_edges + 2 != 2 * used.size()) return "Euler's formula fails";
  return {};
}

std::string verifyDelaunay(const Tin& tin, const std::vector<LatticePoint>& lattice) {
  for (std::size_t t = 0; t < tin.triangles().size(); ++t) {
    const auto& v = tin.triangles()[t].vertex;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t n = tin.triangles()[t].neighbour[i];
      if (n == Tin::kNone) continue;
      const auto& other = tin.triangles()[n];
      int k = 0;
      while (other.neighbour[k] != static_cast<std::int32_t>(t)) ++k;
      const LatticePoint d = lattice[other.vertex[k]], a = lattice[v[i]];
      const LatticePoint b = lattice[v[(i + 1) % 3]], c = lattice[v[(i + 2) % 3]];
      const int sign = inCircleSign(a, b, c, d);
      if (sign > 0) return problem("edge not Delaunay", t);
      if (sign == 0 && std::max(a, d) < std::max(b, c)) return problem("tie on the wrong side", t);
    }
  }
  return {};
}

std::string verifyArea(const Tin& tin, const std::vector<LatticePoint>& lattice) {
  Int128 sum = 0;
  for (std::size_t t = 0; t < tin.triangles().size(); ++t) {
    const auto& v = tin.triangles()[t].vertex;
    const Int128 area = doubledArea(lattice[v[0]], lattice[v[1]], lattice[v[2]]);
    if (area <= 0) return problem("not counter-clockwise", t);
    sum += area;
  }
  return sum == doubledHullArea(lattice) ? std::string() : "areas do not add up to the hull's";
}

}  // namespace

std::vector<Eigen::Vector3d> pointsAt(const std::vector<LatticePoint>& lattice) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(lattice.size());
  for (const LatticePoint& p : lattice)
    points.emplace_back(static_cast<double>(p.x) * 0.001, static_cast<double>(p.y) * 0.001, 0.0);
  return points;
}

std::vector<LatticePoint> latticeOf(const Tin& tin) {
  std::vector<LatticePoint> lattice;
  lattice.reserve(tin.points().size());
  for (const Eigen::Vector3d& p : tin.points())
    lattice.push_back({static_cast<std::int64_t>(std::floor(p.x() / tin.resolution() + 0.5)),
                       static_cast<std::int64_t>(std::floor(p.y() / tin.resolution() + 0.5))});
  return lattice;
}

Int128 doubledArea(LatticePoint a, LatticePoint b, LatticePoint c) {
  return Int128{b.x - a.x} * (c.y - a.y) - Int128{b.y - a.y} * (c.x - a.x);
}

int inCircleSign(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d) {
  // Through barycentric areas of d: the lift of d against the plane through the other lifts.
  const auto lift = [&](LatticePoint p) {
    return Int128{p.x - a.x} * (p.x - a.x) + Int128{p.y - a.y} * (p.y - a.y);
  };
  const Int128 plane = doubledArea(a, d, c) * lift(b) + doubledArea(a, b, d) * lift(c);
  const Int128 above = plane - doubledArea(a, b, c) * lift(d);
  return above > 0 ? 1 : (above < 0 ? -1 : 0);
}

std::string verify(const Tin& tin) {
  const std::vector<LatticePoint> lattice = latticeOf(tin);
  if (lattice.empty()) return tin.triangles().empty() ? "" : "triangles without points";
  for (const auto& check : {verifyVertices(tin, lattice), verifyNeighbours(tin),
                            verifyArea(tin, lattice), verifyDelaunay(tin, lattice)})
    if (!check.empty()) return check;
  return {};
}

PlanTriangle planTriangle(const std::vector<LatticePoint>& lattice, const Tin::Triangle& triangle) {
  PlanTriangle corners{lattice[triangle.vertex[0]], lattice[triangle.vertex[1]],
                       lattice[triangle.vertex[2]]};
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::set<PlanTriangle> planTriangles(const Tin& tin) {
  const std::vector<LatticePoint> lattice = latticeOf(tin);
  std::set<PlanTriangle> triangles;
  for (const Tin::Triangle& t : tin.triangles()) triangles.insert(planTriangle(lattice, t));
  return triangles;
}

}  // namespace pcl_als::test
