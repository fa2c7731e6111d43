// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "ground_planes.h"

namespace pcl_als {
namespace {

constexpr double kSlope = 0.03;

/// One point in each square of 0.5 m of 20 m x 20 m: a plane that rises to the east, with a step of
/// 3 m in the eastern half.
std::vector<Eigen::Vector3d> slopeWithStep(double noise) {
  std::mt19937 random(3);
  std::normal_distribution<double> error(0.0, noise);
  std::vector<Eigen::Vector3d> points;
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column) {
      const double x = 0.25 + 0.5 * column, y = 0.25 + 0.5 * row;
      points.emplace_back(x, y, kSlope * x + (x > 12.0 ? 3.0 : 0.0) + error(random));
    }
  return points;
}

// Cells of 5 m have 100 points, whose columns have a mean square distance of 0.5^2 (10^2 - 1) / 12
// m^2 from their middle: noise of 2 cm tilts a plane by 0.02 / sqrt(100 * 2.0625).
TEST(GroundPlanes, AreThoseOfTheCells) {
  const GroundPlanes planes(slopeWithStep(0.02), 5.0, 0.08);
  const GroundPlanes::Plane* plane = planes.under({0, 1, 40});
  ASSERT_NE(plane, nullptr);
  const double expected = 0.02 / std::sqrt(100.0 * 2.0625);
  EXPECT_NEAR(plane->tilt_std, expected, 0.25 * expected);
  EXPECT_NEAR(plane->normal.x(), -kSlope, 3.5 * expected);
  EXPECT_NEAR(plane->normal.y(), 0.0, 3.5 * expected);
  EXPECT_NEAR(plane->normal.norm(), 1.0, 1e-12);
}

// The step is at 12 m: of the points in cells from 10 to 15 m two fifths are below it, and on no
// plane.
TEST(GroundPlanes, LeaveOutOtherSurfaces) {
  const std::vector<Eigen::Vector3d> points = slopeWithStep(0.02);
  const GroundPlanes planes(points, 5.0, 0.08);
  for (std::int32_t i = 0; i + 41 < 1600; ++i) {
    const double x = points[static_cast<std::size_t>(i)].x();
    if (x > 10.0 && x < 12.0) {
      EXPECT_EQ(planes.under({i, i + 1, i + 40}), nullptr);
    }
  }
  EXPECT_EQ(GroundPlanes().under({0, 1, 2}), nullptr);
  EXPECT_EQ(GroundPlanes(points, 1.0, 0.08).under({0, 1, 40}), nullptr);  // four points
}

TEST(GroundPlanes, MoveWithTheirPoints) {
  std::vector<Eigen::Vector3d> points = slopeWithStep(0.02);
  const GroundPlanes here(points, 5.0, 0.08);
  for (Eigen::Vector3d& point : points) point += Eigen::Vector3d(-1234.5, 2345.25, 100.0);
  const GroundPlanes there(points, 5.0, 0.08);
  for (std::int32_t i = 0; i + 41 < 1600; ++i) {
    const auto *a = here.under({i, i + 1, i + 40}), *b = there.under({i, i + 1, i + 40});
    ASSERT_EQ(a == nullptr, b == nullptr);
    if (a == nullptr) continue;
    EXPECT_LT((a->normal - b->normal).norm(), 1e-9);
  }
}

TEST(GroundPlanes, FollowTheirPoints) {
  std::vector<Eigen::Vector3d> points = slopeWithStep(0.0);
  GroundPlanes planes(points, 5.0, 0.08);
  for (Eigen::Vector3d& point : points) point.z() += 0.01 * point.y() + 7.0;
  planes.fit(points);
  const GroundPlanes::Plane* plane = planes.under({0, 1, 40});
  ASSERT_NE(plane, nullptr);
  const Eigen::Vector3d expected = Eigen::Vector3d(-kSlope, -0.01, 1.0).normalized();
  EXPECT_LT((plane->normal - expected).norm(), 1e-9);
}

}  // namespace
}  // namespace pcl_als
