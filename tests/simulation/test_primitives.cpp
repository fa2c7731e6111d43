// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/primitives.h>

namespace {

using pcl_als::UsageError;
using pcl_als::simulation::Ball;
using pcl_als::simulation::Polygon;

const Eigen::Vector3d kDown(0.0, 0.0, -1.0);

TEST(Polygon, RoofIsHitWhereItsPlaneIs) {
  // A roof rising 45 degrees to the east: z = 10 + x over x 0..4, y 0..6.
  const Polygon roof({{0, 0, 10}, {4, 0, 14}, {4, 6, 14}, {0, 6, 10}});
  const auto range = roof.intersect({1.0, 3.0, 100.0}, kDown);
  ASSERT_TRUE(range.has_value());
  EXPECT_DOUBLE_EQ(*range, 89.0);  // z = 11
  EXPECT_NEAR(roof.normal().x(), -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(roof.normal().z(), std::sqrt(0.5), 1e-15);
}

TEST(Polygon, MissesOutsideAndBehind) {
  const Polygon roof({{0, 0, 10}, {4, 0, 14}, {4, 6, 14}, {0, 6, 10}});
  EXPECT_FALSE(roof.intersect({-0.001, 3.0, 100.0}, kDown).has_value());
  EXPECT_FALSE(roof.intersect({4.001, 3.0, 100.0}, kDown).has_value());
  EXPECT_FALSE(roof.intersect({1.0, 6.001, 100.0}, kDown).has_value());
  EXPECT_FALSE(roof.intersect({1.0, 3.0, 5.0}, kDown).has_value());
}

TEST(Polygon, EitherSenseOfCornersIsTheSame) {
  const Polygon roof({{0, 6, 10}, {4, 6, 14}, {4, 0, 14}, {0, 0, 10}});
  ASSERT_TRUE(roof.intersect({1.0, 3.0, 100.0}, kDown).has_value());
  EXPECT_GT(roof.normal().z(), 0.0);
}

TEST(Polygon, WallIsHitFromTheSideAndMissedByAVerticalRay) {
  const Polygon wall({{0, 0, 0}, {0, 8, 0}, {0, 8, 3}, {0, 0, 3}});
  const Eigen::Vector3d slanted = Eigen::Vector3d(0.6, 0.0, -0.8);
  // From x = -3: the wall is 3 / 0.6 = 5 m away, 4 m lower.
  const auto range = wall.intersect({-3.0, 4.0, 6.0}, slanted);
  ASSERT_TRUE(range.has_value());
  EXPECT_DOUBLE_EQ(*range, 5.0);
  EXPECT_FALSE(wall.intersect({0.0, 4.0, 6.0}, kDown).has_value());
}

TEST(Polygon, GableIsAPentagon) {
  const Polygon gable({{0, -4, 0}, {0, 4, 0}, {0, 4, 3}, {0, 0, 6}, {0, -4, 3}});
  const Eigen::Vector3d east(1.0, 0.0, 0.0);
  EXPECT_TRUE(gable.intersect({-1.0, 0.0, 5.9}, east).has_value());
  EXPECT_TRUE(gable.intersect({-1.0, 1.9, 4.5}, east).has_value());  // edge at y = 2
  EXPECT_FALSE(gable.intersect({-1.0, 2.1, 4.5}, east).has_value());
}

TEST(Polygon, AgreesWithAngleSumInPlan) {
  // A skewed pentagon; inside is decided independently by the sum of the corner angles.
  const std::vector<Eigen::Vector3d> corners = {
      {0, 0, 0}, {5, -1, 0}, {7, 3, 0}, {3, 6, 0}, {-1, 4, 0}};
  const Polygon polygon(corners);
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> place(-2.0, 8.0);
  int inside_count = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d p(place(engine), place(engine));
    double turn = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector2d a = corners[k].head<2>() - p;
      const Eigen::Vector2d b = corners[(k + 1) % corners.size()].head<2>() - p;
      turn += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
    const bool inside = std::abs(turn) > M_PI;
    inside_count += inside ? 1 : 0;
    EXPECT_EQ(polygon.intersect({p.x(), p.y(), 1.0}, kDown).has_value(), inside) << p.transpose();
  }
  EXPECT_GT(inside_count, 500);
}

TEST(Polygon, RefusesTwoOrSixCorners) {
  EXPECT_THROW(Polygon({{0, 0, 0}, {1, 0, 0}}), UsageError);
  EXPECT_THROW(Polygon({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 3, 0}, {0, 1, 0}}),
               UsageError);
}

TEST(Ball, NearSideIsHit) {
  const Ball ball{{0.0, 0.0, 10.0}, 2.0};
  EXPECT_DOUBLE_EQ(*ball.intersect({0.0, 0.0, 100.0}, kDown), 88.0);
  // 1.2 m off the axis: half chord sqrt(4 - 1.44) = 1.6.
  EXPECT_NEAR(*ball.intersect({1.2, 0.0, 100.0}, kDown), 88.4, 1e-12);
  EXPECT_FALSE(ball.intersect({2.1, 0.0, 100.0}, kDown).has_value());
  EXPECT_FALSE(ball.intersect({0.0, 0.0, 5.0}, kDown).has_value());
}

TEST(Ball, HitsLieOnItsSurface) {
  std::mt19937 engine(6);
  std::normal_distribution<double> offset(0.0, 0.3);
  const Ball ball{{3.0, -2.0, 12.0}, 0.6};
  const Eigen::Vector3d origin(200.0, 100.0, 1100.0);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d aim =
        ball.centre + Eigen::Vector3d(offset(engine), offset(engine), offset(engine));
    const Eigen::Vector3d direction = (aim - origin).normalized();
    const auto range = ball.intersect(origin, direction);
    if (!range) continue;
    ++hits;
    const Eigen::Vector3d point = origin + *range * direction;
    EXPECT_NEAR((point - ball.centre).norm(), 0.6, 1e-9);  // rounding at 1000 m, grazing
    EXPECT_LT((point - ball.centre).dot(direction), 1e-9) << "the far side";
  }
  EXPECT_GT(hits, 600);
}

}  // namespace
