// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/tin/tin.h>

#include "plan_sets.h"
#include "tin_verifier.h"

namespace pcl_als {
namespace {

using test::LatticePoint;
using test::pointsAt;
using test::verify;

TEST(Tin, SquareWithCentreByHand) {
  // The centre makes four triangles; nothing is left to a rule of ties.
  const Tin tin(pointsAt({{0, 0}, {2000, 0}, {2000, 2000}, {0, 2000}, {900, 1000}}));
  ASSERT_EQ(tin.triangles().size(), 4U);
  for (const Tin::Triangle& t : tin.triangles()) {
    EXPECT_EQ(std::count(t.vertex.begin(), t.vertex.end(), 4), 1);
    EXPECT_EQ(std::count(t.neighbour.begin(), t.neighbour.end(), Tin::kNone), 1);
  }
  EXPECT_EQ(verify(tin), "");
}

TEST(Tin, TieOfASquareAvoidsTheLastCornerInOrder) {
  // Of the four corners (1, 1) comes last in the order (x, y): the diagonal joins the other two.
  const Tin tin(pointsAt({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  ASSERT_EQ(tin.triangles().size(), 2U);
  const auto diagonal = [](const Tin::Triangle& t) {
    return std::count(t.vertex.begin(), t.vertex.end(), 1) == 1 &&
           std::count(t.vertex.begin(), t.vertex.end(), 3) == 1;
  };
  EXPECT_TRUE(diagonal(tin.triangles()[0]) && diagonal(tin.triangles()[1]));
}

class NastyTin : public testing::TestWithParam<test::PlanSet> {};

TEST_P(NastyTin, IsDelaunay) {
  EXPECT_EQ(verify(Tin(pointsAt(GetParam().points))), "");
}

TEST_P(NastyTin, DoesNotDependOnInputOrder) {
  std::vector<LatticePoint> shuffled = GetParam().points;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(3));
  EXPECT_EQ(test::planTriangles(Tin(pointsAt(shuffled))),
            test::planTriangles(Tin(pointsAt(GetParam().points))));
}

TEST_P(NastyTin, IsTheSameTwice) {
  const Tin a(pointsAt(GetParam().points)), b(pointsAt(GetParam().points));
  ASSERT_EQ(a.triangles().size(), b.triangles().size());
  for (std::size_t t = 0; t < a.triangles().size(); ++t) {
    EXPECT_EQ(a.triangles()[t].vertex, b.triangles()[t].vertex);
    EXPECT_EQ(a.triangles()[t].neighbour, b.triangles()[t].neighbour);
  }
}

INSTANTIATE_TEST_SUITE_P(Tin, NastyTin, testing::ValuesIn(test::nastyPlanSets()),
                         [](const auto& info) { return info.param.name; });

TEST(Tin, SmallSetsFullOfTiesAreDelaunay) {
  for (unsigned seed = 0; seed < 3000; ++seed) {
    const int count = 3 + static_cast<int>(seed % 40);
    const Tin tin(pointsAt(test::randomPlan(count, 2 + seed % 9, seed)));
    ASSERT_EQ(verify(tin), "") << "seed " << seed;
  }
}

TEST(Tin, CollinearInputHasNoTriangles) {
  const Tin tin(pointsAt({{0, 0}, {2, 4}, {1, 2}, {-3, -6}}));
  EXPECT_TRUE(tin.triangles().empty());
  EXPECT_EQ(tin.points().size(), 4U);
  EXPECT_EQ(tin.locate(0.0, 0.0), Tin::kNone);
}

TEST(Tin, FirstOfCoincidingPointsRepresentsThem) {
  std::vector<Eigen::Vector3d> points = pointsAt({{0, 0}, {9, 0}, {0, 9}, {9, 0}, {0, 0}});
  points[3].x() += 0.0004;  // rounds to the same position
  points[3].z() = 5.0;
  const Tin tin(points);
  EXPECT_EQ(tin.mergedPoints(), 2U);
  ASSERT_EQ(tin.triangles().size(), 1U);
  for (const std::int32_t v : tin.triangles()[0].vertex) EXPECT_LT(v, 3);
  EXPECT_EQ(tin.points()[3].z(), 5.0);
}

TEST(Tin, LatticeDoesNotDependOnTheOtherPoints) {
  // At map coordinates, and with a point that moves the extent's corner to an odd place.
  const Eigen::Vector3d map(583394.0005, 5283100.0005, 498.0);
  std::vector<Eigen::Vector3d> points = pointsAt(test::randomPlan(400, 30, 4));
  for (Eigen::Vector3d& p : points) p += map;
  const Tin alone(points);
  points.push_back(map - Eigen::Vector3d(77.7777, 33.3333, 0.0));
  EXPECT_EQ(alone.mergedPoints(), Tin(points).mergedPoints());
}

TEST(Tin, ExtentLimitIsExact) {
  const std::int64_t far = std::int64_t{1} << 24;
  EXPECT_EQ(verify(Tin(pointsAt({{0, 0}, {far, 1}, {5, far}}))), "");
  EXPECT_THROW(Tin(pointsAt({{0, 0}, {far + 1, 1}, {5, 9}})), UsageError);
  EXPECT_THROW(Tin(pointsAt({{0, 0}, {1, far + 1}, {5, 9}})), UsageError);
  EXPECT_NO_THROW(Tin(pointsAt({{0, 0}, {1, far + 1}, {5, 9}}), 0.01));
}

TEST(Tin, RefusesWhatItCannotUse) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity})
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Eigen::Vector3d> points = pointsAt({{0, 0}, {9, 0}, {0, 9}});
      points[1][axis] = bad;
      EXPECT_THROW(Tin{points}, InputError);
    }
  for (const double resolution : {0.0, -1.0, nan, infinity})
    EXPECT_THROW(Tin(pointsAt({{0, 0}, {9, 0}, {0, 9}}), resolution), UsageError);
  EXPECT_THROW(Tin({{1e18, 0.0, 0.0}, {1e18, 1.0, 0.0}}, 0.001), UsageError);
}

TEST(Tin, MovePointsKeepsTopology) {
  std::vector<Eigen::Vector3d> points = pointsAt(test::randomPlan(500, 30000, 2));
  Tin tin(points);
  const std::vector<Tin::Triangle> before = tin.triangles();
  for (Eigen::Vector3d& p : points) p += Eigen::Vector3d(0.25, -0.5, 1.0);
  tin.movePoints(points);
  EXPECT_EQ(tin.points(), points);
  EXPECT_EQ(before.size(), tin.triangles().size());
  points.pop_back();
  EXPECT_THROW(tin.movePoints(points), UsageError);
}

}  // namespace
}  // namespace pcl_als
