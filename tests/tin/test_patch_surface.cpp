// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/tin/patch_surface.h>

#include "surface_sets.h"

namespace pcl_als {
namespace {

using Eigen::Vector3d;

/// Distance of a point from a triangle in 3D by clamping the projection: code of its own.
double distanceByClamping(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  bool inside = true;
  double border = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vector3d edge = t[(i + 1) % 3] - t[i];
    inside = inside && n.cross(edge).dot(p - t[i]) >= 0.0;
    const double along = std::clamp((p - t[i]).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    border = std::min(border, (p - t[i] - along * edge).norm());
  }
  return inside ? std::abs(n.dot(p - t[0])) : border;
}

std::array<Vector3d, 3> cornersOf(const Tin& tin, std::int32_t triangle) {
  const auto& v = tin.triangles()[triangle].vertex;
  return {tin.points()[v[0]], tin.points()[v[1]], tin.points()[v[2]]};
}

/// Checks one answer against trying every triangle. Rounding may choose among triangles whose
/// distances differ by less than 1e-9 m and, there, whether the foot is inside.
void checkAgainstAll(const PatchSurface& surface, const Vector3d& point, double limit) {
  const auto match = surface.closest(point, limit);
  std::vector<double> distance;
  for (std::size_t t = 0; t < surface.tin().triangles().size(); ++t)
    distance.push_back(
        distanceByClamping(point, cornersOf(surface.tin(), static_cast<std::int32_t>(t))));
  const auto closest = std::min_element(distance.begin(), distance.end());
  if (match) {
    EXPECT_NEAR(distance[match->triangle], *closest, 1e-9);
    EXPECT_NEAR(std::abs(match->signed_normal_distance), *closest, 1e-9);
    EXPECT_LE(std::abs(match->signed_normal_distance), limit);
    return;
  }
  if (*closest > limit) return;
  // Rejected: then the foot on the closest triangle is not well inside it.
  const auto t = static_cast<std::int32_t>(closest - distance.begin());
  const std::array<Vector3d, 3> corner = cornersOf(surface.tin(), t);
  const Vector3d n = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  double least = 1.0;
  for (int i = 0; i < 3; ++i) {
    const Vector3d edge = corner[(i + 1) % 3] - corner[i];
    least = std::min(least, n.cross(edge).dot(point - corner[i]) / edge.norm());
  }
  EXPECT_LT(least, 1e-9) << "point " << point.transpose() << ", triangle " << t;
}

TEST(PatchSurface, OneTiltedTriangleByHand) {
  // z = x: the normal is (-1, 0, 1) / sqrt 2; a point 2 m above (1, 1, 1) is sqrt 2 from the plane.
  const PatchSurface surface(Tin({{0, 0, 0}, {4, 0, 4}, {0, 4, 0}}));
  const auto match = surface.closest({1.0, 1.0, 3.0}, 2.0);
  ASSERT_TRUE(match);
  EXPECT_EQ(match->triangle, 0);
  const double h = std::sqrt(0.5);
  EXPECT_NEAR((match->normal - Vector3d(-h, 0.0, h)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(match->signed_normal_distance, std::sqrt(2.0), 1e-15);
  EXPECT_NEAR((match->foot - Vector3d(2.0, 1.0, 2.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(match->weights.sum(), 1.0, 1e-15);
  EXPECT_LT(surface.closest({1.0, 1.0, -1.0}, 2.0)->signed_normal_distance, 0.0);
  EXPECT_FALSE(surface.closest({1.0, 1.0, 3.0}, 1.41));  // sqrt 2 is just too far
  EXPECT_FALSE(surface.closest({0.1, 1.0, -1.1}, 2.0));  // projects to x = -0.5, outside
}

TEST(PatchSurface, FootIsTheWeightedSumOfTheCorners) {
  const PatchSurface surface(Tin(test::scenePoints(2000, 0.02, 1)));
  for (const Vector3d& p : test::scenePoints(500, 0.1, 2)) {
    const auto match = surface.closest(p, 1.0);
    if (!match) continue;
    const auto corner = cornersOf(surface.tin(), match->triangle);
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < 3; ++i) sum += match->weights[i] * corner[i];
    EXPECT_NEAR((sum - match->foot).norm(), 0.0, 1e-9);  // rounding of slivers' weights
    EXPECT_GE(match->weights.minCoeff(), 0.0);
    EXPECT_NEAR((p - match->foot - match->signed_normal_distance * match->normal).norm(), 0.0,
                1e-12);
  }
}

TEST(PatchSurface, ClosestEqualsTryingAllNearTheSurface) {
  const PatchSurface surface(Tin(test::scenePoints(1500, 0.02, 3)));
  for (const Vector3d& p : test::scenePoints(1500, 0.1, 4)) checkAgainstAll(surface, p, 0.5);
}

TEST(PatchSurface, ClosestEqualsTryingAllAnywhere) {
  // Beside and above roofs, under the ground, outside the hull; thresholds short and endless.
  const PatchSurface surface(Tin(test::scenePoints(1500, 0.02, 5)));
  std::mt19937 random(6);
  std::uniform_real_distribution<double> plan(-10.0, 70.0), height(-5.0, 20.0);
  const double limits[] = {0.5, 3.0, 1e6, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < 1500; ++i)
    checkAgainstAll(surface, {plan(random), plan(random), height(random)}, limits[i % 4]);
}

TEST(PatchSurface, ClosestEqualsTryingAllAboveVerticesAndEdges) {
  const PatchSurface surface(Tin(test::scenePoints(1000, 0.0, 7)));
  std::mt19937 random(8);
  std::normal_distribution<double> height(0.0, 0.3);
  for (std::size_t t = 0; t < surface.tin().triangles().size(); t += 3) {
    const auto corner = cornersOf(surface.tin(), static_cast<std::int32_t>(t));
    const Vector3d up(0.0, 0.0, height(random));
    for (const Vector3d& p :
         {corner[0], Vector3d(corner[0] + up), Vector3d(0.5 * (corner[0] + corner[1])),
          Vector3d(0.5 * (corner[1] + corner[2]) + up)})
      checkAgainstAll(surface, p, 1.0);
  }
}

TEST(PatchSurface, WallBesideAPointIsCloserThanTheGroundBelow) {
  // Ground at 0, roof at 6 from x = 10: a wall of steep triangles between x = 9.9 and 10.
  std::vector<Vector3d> points;
  for (int i = 0; i <= 20; ++i)
    for (const auto& [x, z] : {std::pair(0.0, 0.0), {9.9, 0.0}, {10.0, 6.0}, {20.0, 6.0}})
      points.emplace_back(x, i, z);
  const PatchSurface surface{Tin(points)};
  const auto match = surface.closest({9.6, 10.2, 3.0}, 5.0);  // 3 m above ground, 0.35 m from wall
  ASSERT_TRUE(match);
  EXPECT_NEAR(std::abs(match->signed_normal_distance), 0.35, 0.02);
  EXPECT_GT(surface.quality(match->triangle).slope, 1.5F);
  // A search that only looks below would have taken the ground.
  EXPECT_NEAR(surface.vertical({9.6, 10.2, 3.0})->signed_normal_distance, 3.0, 1e-12);
}

TEST(PatchSurface, OfEquallyCloseOnesTheLowestIndex) {
  // A trench symmetrical about x = 0, its floor farther from the point than both walls. All numbers
  // are exact, so the walls are equally close; the search starts from the floor.
  std::vector<Vector3d> points;
  for (int y = 0; y <= 64; y += 4)
    for (const auto& [x, z] : {std::pair(-2.0, 4.0), {-1.0, 0.0}, {1.0, 0.0}, {2.0, 4.0}})
      points.emplace_back(x, y, z);
  const PatchSurface surface{Tin(points)};
  for (double y = 2.5; y < 62.0; y += 1.0) {
    const Vector3d middle(0.0, y, 3.0);
    std::vector<std::int32_t> ties;
    for (std::int32_t t = 0; t < static_cast<std::int32_t>(surface.tin().triangles().size()); ++t)
      if (std::abs(distanceByClamping(middle, cornersOf(surface.tin(), t)) -
                   7.0 / std::sqrt(17.0)) < 1e-12)
        ties.push_back(t);
    ASSERT_EQ(ties.size(), 2U);
    const auto match = surface.closest(middle, 2.0);
    ASSERT_TRUE(match);
    EXPECT_EQ(match->triangle, ties.front());
  }
}

TEST(PatchSurface, PointsOverEveryCornerAndEdgeOfAPlaneHaveAPatch) {
  // On a plane the projection always falls on some triangle, its edges included.
  const PatchSurface surface(Tin(test::planePoints(0.3, -0.2, 10.0, 0.5)));
  const Vector3d lift = 0.1 * Vector3d(-0.3, 0.2, 1.0).normalized();
  for (std::size_t t = 0; t < surface.tin().triangles().size(); ++t) {
    const auto corner = cornersOf(surface.tin(), static_cast<std::int32_t>(t));
    for (int i = 0; i < 3; ++i) {
      const Vector3d middle = 0.5 * (corner[i] + corner[(i + 1) % 3]);
      for (const Vector3d& p : {corner[i], middle}) {
        const auto match = surface.closest(p + lift, 0.2);
        ASSERT_TRUE(match) << p.transpose();
        EXPECT_NEAR(match->signed_normal_distance, 0.1, 1e-12);
      }
    }
  }
}

TEST(PatchSurface, VerticalByHand) {
  const PatchSurface surface(Tin({{0, 0, 0}, {4, 0, 4}, {0, 4, 0}}));
  const auto match = surface.vertical({1.0, 1.0, 3.0});
  ASSERT_TRUE(match);
  EXPECT_NEAR((match->weights - Vector3d(0.5, 0.25, 0.25)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(match->signed_normal_distance, std::sqrt(2.0), 1e-15);
  EXPECT_TRUE(surface.vertical({2.0, 2.0, 9.0}));  // on the hull
  EXPECT_FALSE(surface.vertical({2.001, 2.0, 9.0}));
}

TEST(PatchSurface, NothingToFind) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const PatchSurface empty, surface(Tin({{0, 0, 0}, {4, 0, 4}, {0, 4, 0}}));
  EXPECT_FALSE(empty.closest({0.0, 0.0, 0.0}, 1.0));
  EXPECT_FALSE(empty.vertical({0.0, 0.0, 0.0}));
  EXPECT_FALSE(surface.closest({nan, 1.0, 1.0}, 1.0));
  EXPECT_FALSE(surface.closest({1.0, 1.0, nan}, 1.0));
  EXPECT_FALSE(surface.vertical({1.0, nan, 1.0}));
  for (const double bad : {0.0, -1.0, nan})
    EXPECT_THROW(surface.closest({1, 1, 1}, bad), UsageError);
}

TEST(PatchSurface, MovedPointsMoveThePatches) {
  std::vector<Vector3d> points = test::planePoints(0.0, 0.0, 10.0, 0.5);
  PatchSurface surface{Tin(points)};
  for (Vector3d& p : points) p.z() += 0.1 + 0.01 * p.x();
  surface.movePoints(points);
  const auto match = surface.closest({4.2, 5.1, 0.0}, 1.0);
  ASSERT_TRUE(match);
  EXPECT_NEAR(match->normal.x(), -0.01 / std::hypot(1.0, 0.01), 1e-12);
  EXPECT_NEAR(match->signed_normal_distance, -0.142 / std::hypot(1.0, 0.01), 1e-12);
}

/// 2026-11-21: positions that fell into no triangle of a TIN whose points had been moved across
/// each other sent the search along a hull that was not there, for ever.
TEST(PatchSurface, PointsMovedAcrossEachOtherStillHaveAnEnd) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> plan(0.0, 20.0), shift(-3.0, 3.0), around(-8.0, 28.0);
  std::vector<Vector3d> points(800);
  for (Vector3d& p : points) p = Vector3d(plan(random), plan(random), 0.0);
  PatchSurface surface{Tin(points)};
  for (Vector3d& p : points) p += Vector3d(shift(random), shift(random), 0.0);
  surface.movePoints(points);
  int outside = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector3d at(around(random), around(random), 0.1);
    surface.closest(at, 0.5);
    outside += surface.tin().locate(at.x(), at.y()) == Tin::kNone ? 1 : 0;
  }
  EXPECT_GT(outside, 500);
}

/// 2026-11-22: where corrections moved points past each other, walks through inverted triangles
/// ended in a search of all triangles: 291 s instead of 7 s for 388,000 points of a conical
/// scanner.
TEST(PatchSurface, PointsThatPassEachOtherAreTriangulatedAgain) {
  std::vector<Vector3d> points = test::scenePoints(4000, 0.0, 5);
  PatchSurface surface{Tin(points)};
  // Every other point belongs to another look of the scanner and moves another way.
  for (std::size_t i = 0; i < points.size(); ++i) points[i].x() += i % 2 == 0 ? 0.2 : -0.2;
  surface.movePoints(points);
  const Tin again(points);
  ASSERT_EQ(surface.tin().triangles().size(), again.triangles().size());
  for (std::size_t t = 0; t < again.triangles().size(); ++t)
    ASSERT_EQ(surface.tin().triangles()[t].vertex, again.triangles()[t].vertex);
}

TEST(PatchSurface, TopologyIsKeptWhereItRemainsATriangulation) {
  std::vector<Vector3d> points = test::scenePoints(4000, 0.0, 5);
  PatchSurface surface{Tin(points)};
  const std::vector<Tin::Triangle> before = surface.tin().triangles();
  for (Vector3d& p : points) p += Vector3d(0.3, -0.2, 0.1) + 1e-4 * p;
  surface.movePoints(points);
  for (std::size_t t = 0; t < before.size(); ++t)
    ASSERT_EQ(surface.tin().triangles()[t].vertex, before[t].vertex);
}

/// Triangles inside the hull that are clockwise, counted by the sign of their area.
std::size_t invertedTriangles(const Tin& tin) {
  std::size_t count = 0;
  for (const Tin::Triangle& t : tin.triangles()) {
    if (std::count(t.neighbour.begin(), t.neighbour.end(), Tin::kNone) > 0) continue;
    const Vector3d ab = tin.points()[t.vertex[1]] - tin.points()[t.vertex[0]];
    const Vector3d ac = tin.points()[t.vertex[2]] - tin.points()[t.vertex[0]];
    count += ab.x() * ac.y() - ab.y() * ac.x() <= 0.0 ? 1 : 0;
  }
  return count;
}

/// The rule: up to one inverted triangle in a thousand is kept, more are triangulated again. One
/// point after the other of a grid is moved past its neighbour, until that happens.
TEST(PatchSurface, MoreThanOneInvertedTriangleInAThousandAreTriangulatedAgain) {
  const std::vector<Vector3d> points = test::planePoints(0.0, 0.0, 100.0, 1.0);
  const double triangles = static_cast<double>(Tin(points).triangles().size());
  std::size_t most_kept = 0, moved_points = 0;
  bool again = false;
  for (std::vector<Vector3d> moved = points; !again; ++moved_points) {
    ASSERT_LT(moved_points, 40U);
    const double x = 10.0 + 10.0 * static_cast<double>(moved_points % 8);
    const double y = 10.0 + 10.0 * static_cast<double>(moved_points / 8);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (std::hypot(points[i].x() - x, points[i].y() - y) < 0.4) moved[i].x() += 1.3;
    }
    PatchSurface surface{Tin(points)};
    surface.movePoints(moved);
    const std::size_t inverted = invertedTriangles(surface.tin());
    again = moved_points > 0 && inverted == 0;  // a new triangulation has none
    most_kept = std::max(most_kept, inverted);
  }
  EXPECT_GT(most_kept, 0U);
  EXPECT_LE(static_cast<double>(most_kept), 1e-3 * triangles);
  // One moved point inverts fewer than eight triangles: the next was over the limit.
  EXPECT_GT(static_cast<double>(most_kept + 8), 1e-3 * triangles);
}

/// A few inverted triangles are kept: positions beside them are still found.
TEST(PatchSurface, PositionsAreFoundAmongFewInvertedTriangles) {
  std::vector<Vector3d> points = test::planePoints(0.0, 0.0, 100.0, 1.0);
  PatchSurface surface{Tin(points)};
  const std::vector<Tin::Triangle> before = surface.tin().triangles();
  std::size_t moved = 0;
  for (Vector3d& p : points) {
    if (std::hypot(p.x() - 50.0, p.y() - 50.0) > 0.8) continue;
    p.x() += 1.3;
    ++moved;
  }
  ASSERT_GT(moved, 0U);
  surface.movePoints(points);
  ASSERT_EQ(surface.tin().triangles().front().vertex, before.front().vertex);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> plan(5.0, 95.0);
  for (int i = 0; i < 20000; ++i) {
    const double x = i % 2 == 0 ? plan(random) : 48.0 + 0.06 * (plan(random) - 5.0);
    const double y = i % 2 == 0 ? plan(random) : 48.0 + 0.04 * (plan(random) - 5.0);
    ASSERT_NE(surface.tin().locate(x, y), Tin::kNone) << x << ' ' << y;
  }
}

TEST(PatchSurface, HintsAndThreadsChangeNothing) {
  const PatchSurface surface(Tin(test::scenePoints(5000, 0.02, 9)));
  const std::vector<Vector3d> queries = test::scenePoints(8000, 0.2, 10);
  std::vector<std::int32_t> plain, hinted(queries.size(), Tin::kNone);
  for (const Vector3d& p : queries) {
    const auto match = surface.closest(p, 0.5);
    plain.push_back(match ? match->triangle : Tin::kNone);
  }
  parallelFor(80, 8, [&](std::size_t chunk) {
    std::int32_t hint = Tin::kNone;
    for (std::size_t i = chunk * 100; i < chunk * 100 + 100; ++i)
      if (const auto match = surface.closest(queries[i], 0.5, hint)) hinted[i] = match->triangle;
  });
  EXPECT_EQ(plain, hinted);
}

TEST(PatchSurface, PointsThatMoveFindWhatASearchFinds) {
  const PatchSurface surface(Tin(test::scenePoints(5000, 0.02, 9)));
  constexpr double kMargin = 0.05;
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::size_t searches = 0, calls = 0, found = 0;
  for (Vector3d point : test::scenePoints(500, 0.2, 10)) {
    PatchSearch last;
    for (int i = 0; i < 30; ++i) {
      // From movements far beyond the margin to those of an iteration that has nearly converged.
      const double step = 0.5 * std::pow(0.7, i), limit = i < 3 || i == 20 ? 2.0 : 0.25;
      point += step * Vector3d(normal(random), normal(random), normal(random));
      const auto expected = surface.closest(point, limit);
      const auto match = surface.closest(point, limit, kMargin, last);
      ++calls;
      if (last.point == point) ++searches;
      ASSERT_EQ(match.has_value(), expected.has_value());
      if (!match) continue;
      ++found;
      EXPECT_EQ(match->triangle, expected->triangle);
      EXPECT_EQ(match->signed_normal_distance, expected->signed_normal_distance);
      EXPECT_EQ(match->normal, expected->normal);
      EXPECT_EQ(match->foot, expected->foot);
      EXPECT_EQ(match->weights, expected->weights);
    }
  }
  EXPECT_GT(found, calls / 4);
  EXPECT_LT(searches, calls / 2);
  PatchSearch last;
  EXPECT_THROW(surface.closest({1, 1, 1}, -1.0, kMargin, last), UsageError);
  EXPECT_FALSE(PatchSurface().closest({1, 1, 1}, 1.0, kMargin, last));
}

TEST(PatchSurface, SameAnswerAtMapCoordinates) {
  // Coordinates of 5e6 m carry steps of 1e-9 m; distances agree to a few of them.
  const Vector3d map(583394.0, 5283100.0, 498.0);
  std::vector<Vector3d> points = test::scenePoints(2000, 0.02, 11);
  const PatchSurface here{Tin(points)};
  for (Vector3d& p : points) p += map;
  const PatchSurface there{Tin(points)};
  for (const Vector3d& p : test::scenePoints(500, 0.1, 12)) {
    const auto a = here.closest(p, 0.5), b = there.closest(p + map, 0.5);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    EXPECT_EQ(a->triangle, b->triangle);
    EXPECT_NEAR(a->signed_normal_distance, b->signed_normal_distance, 1e-6);  // slivers amplify
  }
}

}  // namespace
}  // namespace pcl_als
