// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// A TIN built from a tile and a margin against the TIN of the whole.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "plan_sets.h"
#include "tin_verifier.h"

namespace pcl_als {
namespace {

using test::LatticePoint;
using test::PlanTriangle;

Eigen::AlignedBox2d box(double x0, double y0, double x1, double y1) {
  return {Eigen::Vector2d(x0, y0), Eigen::Vector2d(x1, y1)};
}

/// The points of a plan box, borders included, in input order.
std::vector<Eigen::Vector3d> within(const std::vector<Eigen::Vector3d>& points,
                                    const Eigen::AlignedBox2d& covered) {
  std::vector<Eigen::Vector3d> inside;
  for (const Eigen::Vector3d& p : points)
    if (covered.contains(p.head<2>())) inside.push_back(p);
  return inside;
}

std::set<PlanTriangle> certainTriangles(const Tin& tin, const Eigen::AlignedBox2d& covered) {
  const std::vector<LatticePoint> lattice = test::latticeOf(tin);
  std::set<PlanTriangle> triangles;
  for (std::size_t t = 0; t < tin.triangles().size(); ++t)
    if (tin.certain(static_cast<std::int32_t>(t), covered))
      triangles.insert(test::planTriangle(lattice, tin.triangles()[t]));
  return triangles;
}

/// Whether a triangle touches a plan box, by its bounding box.
bool touches(const PlanTriangle& t, const Eigen::AlignedBox2d& tile) {
  Eigen::AlignedBox2d bounds;
  for (const LatticePoint& p : t)
    bounds.extend(Eigen::Vector2d(static_cast<double>(p.x), static_cast<double>(p.y)) * 0.001);
  return bounds.intersects(tile);
}

/// Checks one tile; returns how many triangles at the tile (not its margin) are not certain.
std::size_t checkTile(const std::vector<Eigen::Vector3d>& points, const Eigen::AlignedBox2d& tile,
                      double margin) {
  const Eigen::AlignedBox2d covered = box(tile.min().x() - margin, tile.min().y() - margin,
                                          tile.max().x() + margin, tile.max().y() + margin);
  const Tin whole(points), part(within(points, covered));
  const std::set<PlanTriangle> all = test::planTriangles(whole);
  const std::set<PlanTriangle> certain = certainTriangles(part, covered);
  EXPECT_EQ(certain, certainTriangles(whole, covered));
  EXPECT_TRUE(std::includes(all.begin(), all.end(), certain.begin(), certain.end()));
  return std::count_if(all.begin(), all.end(), [&](const PlanTriangle& t) {
    return touches(t, tile) && certain.count(t) == 0;
  });
}

const Eigen::AlignedBox2d kTile = box(40.0, 40.0, 60.0, 60.0);

TEST(TinTiles, RandomPoints) {
  // 4 points/m2: gaps of more than 4 m do not happen, so the tile itself is certain.
  EXPECT_EQ(checkTile(test::pointsAt(test::randomPlan(40000, 100000, 1)), kTile, 4.0), 0U);
}

TEST(TinTiles, GridOfTiesWithTheTileOnItsLines) {
  EXPECT_EQ(checkTile(test::pointsAt(test::grid(201, 201, 500)), kTile, 1.0), 0U);
}

TEST(TinTiles, ScanLines) {
  const auto points = test::pointsAt(test::scanLines(60, 400, 2));
  EXPECT_EQ(checkTile(points, box(20.0, 20.0, 60.0, 60.0), 12.0), 0U);
}

TEST(TinTiles, VoidOverTheTileBorderIsNotCertain) {
  // A pond of 14 m across the margin: the triangles over it depend on points outside.
  std::vector<Eigen::Vector3d> points = test::pointsAt(test::randomPlan(40000, 100000, 3));
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const Eigen::Vector3d& p) {
                                return (p.head<2>() - Eigen::Vector2d(62.0, 50.0)).norm() < 7.0;
                              }),
               points.end());
  EXPECT_GT(checkTile(points, kTile, 4.0), 0U);
}

TEST(TinTiles, DuplicatesOnTheBorder) {
  std::vector<LatticePoint> lattice = test::grid(201, 201, 500);
  lattice.insert(lattice.end(), lattice.begin(), lattice.begin() + 20000);
  EXPECT_EQ(checkTile(test::pointsAt(lattice), kTile, 1.0), 0U);
}

TEST(TinTiles, OffTheLatticeAtMapCoordinates) {
  std::vector<Eigen::Vector3d> points = test::pointsAt(test::randomPlan(20000, 100000, 4));
  const Eigen::Vector3d map(583394.00037, 5283100.00049, 0.0);
  for (Eigen::Vector3d& p : points) p += map;
  const Eigen::AlignedBox2d covered =
      box(map.x() + 30.0, map.y() + 30.0, map.x() + 70.0, map.y() + 70.0);
  EXPECT_EQ(certainTriangles(Tin(within(points, covered)), covered),
            certainTriangles(Tin(points), covered));
}

TEST(TinTiles, WithoutTheTestSomeTrianglesOfAPartAreWrong) {
  const auto points = test::pointsAt(test::randomPlan(40000, 100000, 5));
  const Tin whole(points), part(within(points, kTile));
  const std::set<PlanTriangle> all = test::planTriangles(whole), some = test::planTriangles(part);
  EXPECT_FALSE(std::includes(all.begin(), all.end(), some.begin(), some.end()));
}

TEST(TinTiles, CertaintyByHand) {
  // Right triangle 3, 4, 5: the circle about (1.5, 2) has radius 2.5 and spans [-1, 4] x
  // [-0.5, 4.5].
  const Tin tin(test::pointsAt({{0, 0}, {3000, 0}, {0, 4000}}));
  EXPECT_TRUE(tin.certain(0, box(-1.003, -0.503, 4.003, 4.503)));
  EXPECT_FALSE(tin.certain(0, box(-0.999, -0.503, 4.003, 4.503)));
  EXPECT_FALSE(tin.certain(0, box(-1.003, -0.499, 4.003, 4.503)));
  EXPECT_FALSE(tin.certain(0, box(-1.003, -0.503, 3.999, 4.503)));
  EXPECT_FALSE(tin.certain(0, box(-1.003, -0.503, 4.003, 4.499)));
}

}  // namespace
}  // namespace pcl_als
