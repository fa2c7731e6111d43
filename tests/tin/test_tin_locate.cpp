// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/parallel.h>

#include "exact_orientation.h"
#include "plan_sets.h"

namespace pcl_als {
namespace {

/// The lowest triangle that holds a position, by trying all.
std::int32_t locateByTryingAll(const Tin& tin, double x, double y) {
  for (std::size_t t = 0; t < tin.triangles().size(); ++t) {
    bool holds = true;
    for (int i = 0; i < 3 && holds; ++i) {
      const Eigen::Vector3d& a = tin.points()[tin.triangles()[t].vertex[i]];
      const Eigen::Vector3d& b = tin.points()[tin.triangles()[t].vertex[(i + 1) % 3]];
      holds = tin::orientation(a.x(), a.y(), b.x(), b.y(), x, y) >= 0.0;
    }
    if (holds) return static_cast<std::int32_t>(t);
  }
  return Tin::kNone;
}

/// Positions inside, outside, on vertices and (where doubles allow) on edges.
std::vector<Eigen::Vector2d> positions(const Tin& tin, int count, unsigned seed) {
  std::mt19937 random(seed);
  Eigen::AlignedBox2d extent;
  for (const Eigen::Vector3d& p : tin.points()) extent.extend(p.head<2>());
  std::uniform_real_distribution<double> unit(-0.2, 1.2);
  std::vector<Eigen::Vector2d> result;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d a = tin.points()[random() % tin.points().size()].head<2>();
    const Eigen::Vector2d b = tin.points()[random() % tin.points().size()].head<2>();
    const Eigen::Vector2d free(unit(random), unit(random));
    if (i % 3 == 0) result.push_back(a);
    if (i % 3 == 1) result.emplace_back(0.5 * (a + b));
    if (i % 3 == 2) result.emplace_back(extent.min() + free.cwiseProduct(extent.sizes()));
  }
  return result;
}

class NastyLocate : public testing::TestWithParam<test::PlanSet> {};

TEST_P(NastyLocate, EqualsTryingAllFromAnyHint) {
  const Tin tin(test::pointsAt(GetParam().points));
  if (tin.triangles().empty()) return;
  std::mt19937 random(1);
  for (const Eigen::Vector2d& p : positions(tin, 300, 2)) {
    const std::int32_t expected = locateByTryingAll(tin, p.x(), p.y());
    const auto hint = static_cast<std::int32_t>(random() % tin.triangles().size());
    ASSERT_EQ(tin.locate(p.x(), p.y()), expected) << p.transpose();
    ASSERT_EQ(tin.locate(p.x(), p.y(), hint), expected) << p.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Tin, NastyLocate, testing::ValuesIn(test::nastyPlanSets()),
                         [](const auto& info) { return info.param.name; });

TEST(TinLocate, SquareByHand) {
  const Tin tin(test::pointsAt({{0, 0}, {2000, 0}, {2000, 2000}, {0, 2000}}));
  EXPECT_EQ(tin.locate(1.0, 1.0), 0);  // on the diagonal: the lower index
  EXPECT_NE(tin.locate(0.5, 0.5), tin.locate(1.5, 1.5));
  EXPECT_NE(tin.locate(2.0, 0.5), Tin::kNone);  // on the hull
  EXPECT_EQ(tin.locate(std::nextafter(2.0, 3.0), 0.5), Tin::kNone);
}

TEST(TinLocate, OutsideEndsAtAHullTriangleThatSeesThePosition) {
  const Tin tin(test::pointsAt(test::randomPlan(2000, 50000, 3)));
  for (const Eigen::Vector2d& p : positions(tin, 3000, 4)) {
    const Tin::Location found = tin.walk(p.x(), p.y());
    ASSERT_NE(found.triangle, Tin::kNone);
    if (found.inside) continue;
    const Tin::Triangle& t = tin.triangles()[found.triangle];
    bool sees = false;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = tin.points()[t.vertex[(i + 1) % 3]];
      const Eigen::Vector3d& b = tin.points()[t.vertex[(i + 2) % 3]];
      sees = sees || (t.neighbour[i] == Tin::kNone &&
                      tin::orientation(a.x(), a.y(), b.x(), b.y(), p.x(), p.y()) < 0.0);
    }
    EXPECT_TRUE(sees);
  }
}

TEST(TinLocate, CornerThatRoundsIntoTheNextCell) {
  // 2026-11-21: extent / cell and extent * (1 / cell) rounded to either side of a whole number, and
  // the last corner fell beyond the starting grid (seen by the address sanitizer).
  const std::vector<test::LatticePoint> lattice{{0, 0},   {0, 30},  {0, 60},   {0, 90},
                                                {0, 120}, {0, 150}, {50, 0},   {50, 30},
                                                {50, 60}, {50, 90}, {50, 140}, {50, 150}};
  const Tin tin(test::pointsAt(lattice));
  for (const Eigen::Vector3d& p : tin.points()) EXPECT_NE(tin.locate(p.x(), p.y()), Tin::kNone);
}

TEST(TinLocate, NothingToFind) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Tin tin(test::pointsAt({{0, 0}, {2000, 0}, {0, 2000}}));
  EXPECT_EQ(tin.locate(nan, 0.0), Tin::kNone);
  EXPECT_EQ(tin.locate(0.0, std::numeric_limits<double>::infinity()), Tin::kNone);
  EXPECT_EQ(Tin().locate(0.0, 0.0), Tin::kNone);
}

TEST(TinLocate, FollowsMovedPoints) {
  std::vector<Eigen::Vector3d> points = test::pointsAt(test::randomPlan(3000, 60000, 5));
  Tin tin(points);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> shift(-0.02, 0.02);  // some triangles turn over
  for (Eigen::Vector3d& p : points) p += Eigen::Vector3d(5.0 + shift(random), shift(random), 0.0);
  tin.movePoints(points);
  for (const Eigen::Vector2d& p : positions(tin, 300, 7)) {
    const std::int32_t found = tin.locate(p.x(), p.y());
    if (found == Tin::kNone) continue;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = points[tin.triangles()[found].vertex[i]];
      const Eigen::Vector3d& b = points[tin.triangles()[found].vertex[(i + 1) % 3]];
      ASSERT_GE(tin::orientation(a.x(), a.y(), b.x(), b.y(), p.x(), p.y()), 0.0);
    }
  }
}

TEST(TinLocate, ThreadsFindTheSame) {
  const Tin tin(test::pointsAt(test::randomPlan(20000, 100000, 8)));
  const std::vector<Eigen::Vector2d> where = positions(tin, 8000, 9);
  std::vector<std::int32_t> one(where.size()), eight(where.size());
  const auto run = [&](std::vector<std::int32_t>& found, int threads) {
    parallelFor(80, threads, [&](std::size_t chunk) {
      for (std::size_t i = chunk * 100; i < chunk * 100 + 100; ++i)
        found[i] = tin.locate(where[i].x(), where[i].y());
    });
  };
  run(one, 1);
  run(eight, 8);
  EXPECT_EQ(one, eight);
}

}  // namespace
}  // namespace pcl_als
