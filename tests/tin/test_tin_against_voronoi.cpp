// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The same integers given to Boost.Polygon's Voronoi diagram, whose dual is a Delaunay
// triangulation.
#include <algorithm>
#include <set>
#include <utility>

#include <boost/polygon/voronoi.hpp>
#include <gtest/gtest.h>

#include "plan_sets.h"
#include "tin_verifier.h"

namespace pcl_als {
namespace {

using test::LatticePoint;
using PlanEdge = std::pair<LatticePoint, LatticePoint>;

PlanEdge ordered(LatticePoint a, LatticePoint b) {
  return b < a ? PlanEdge(b, a) : PlanEdge(a, b);
}

std::set<PlanEdge> voronoiEdges(std::vector<LatticePoint> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<boost::polygon::point_data<int>> input;
  for (const LatticePoint& p : points) input.emplace_back(p.x, p.y);
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(input.begin(), input.end(), &diagram);
  std::set<PlanEdge> edges;
  for (const auto& edge : diagram.edges())
    edges.insert(
        ordered(points[edge.cell()->source_index()], points[edge.twin()->cell()->source_index()]));
  return edges;
}

/// The edges of a TIN; \a ties gets those whose four points lie on a circle.
std::set<PlanEdge> tinEdges(const Tin& tin, std::set<PlanEdge>& ties) {
  const std::vector<LatticePoint> lattice = test::latticeOf(tin);
  std::set<PlanEdge> edges;
  for (std::size_t k = 0; k < tin.triangles().size(); ++k) {
    const Tin::Triangle& t = tin.triangles()[k];
    for (int i = 0; i < 3; ++i) {
      const LatticePoint b = lattice[t.vertex[(i + 1) % 3]], c = lattice[t.vertex[(i + 2) % 3]];
      edges.insert(ordered(b, c));
      if (t.neighbour[i] == Tin::kNone) continue;
      const Tin::Triangle& other = tin.triangles()[t.neighbour[i]];
      const auto back =
          std::find(other.neighbour.begin(), other.neighbour.end(), static_cast<int>(k));
      const LatticePoint d = lattice[other.vertex[back - other.neighbour.begin()]];
      if (test::inCircleSign(lattice[t.vertex[i]], b, c, d) == 0) ties.insert(ordered(b, c));
    }
  }
  return edges;
}

void expectDual(const std::vector<LatticePoint>& points) {
  const Tin tin(test::pointsAt(points));
  if (tin.triangles().empty()) return;
  std::set<PlanEdge> ties;
  const std::set<PlanEdge> ours = tinEdges(tin, ties), theirs = voronoiEdges(points);
  for (const PlanEdge& edge : theirs)
    EXPECT_TRUE(ours.count(edge) == 1) << edge.first.x << " " << edge.first.y;
  for (const PlanEdge& edge : ours)
    EXPECT_TRUE(theirs.count(edge) == 1 || ties.count(edge) == 1) << edge.first.x;
}

class TinAgainstVoronoi : public testing::TestWithParam<test::PlanSet> {};

TEST_P(TinAgainstVoronoi, SameEdgesUpToTies) {
  expectDual(GetParam().points);
}

INSTANTIATE_TEST_SUITE_P(Nasty, TinAgainstVoronoi, testing::ValuesIn(test::nastyPlanSets()),
                         [](const auto& info) { return info.param.name; });

TEST(TinAgainstVoronoi, LargeRandomSetHasTheSameEdges) {
  const std::vector<LatticePoint> points = test::randomPlan(50000, 200000, 21);
  const Tin tin(test::pointsAt(points));
  std::set<PlanEdge> ties;
  const std::set<PlanEdge> ours = tinEdges(tin, ties);
  EXPECT_LT(ties.size(), 20U);  // about one in 10^4 at this density
  EXPECT_GE(ours.size(), voronoiEdges(points).size());
  expectDual(points);
}

TEST(TinAgainstVoronoi, LargeScanLinesHaveTheSameEdges) {
  expectDual(test::scanLines(60, 800, 22));
}

}  // namespace
}  // namespace pcl_als
