// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/radiometry/local_surfaces.h>

namespace pcl_als {
namespace {

using Points = std::vector<Eigen::Vector3f>;

/// Points every half metre, jittered, on a height field.
template <typename Height>
Points field(const Height& height, float noise = 0.0F) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> jitter(-0.15F, 0.15F);
  std::normal_distribution<float> error(0.0F, 1.0F);
  Points points;
  for (int row = -30; row <= 30; ++row) {
    for (int column = -30; column <= 30; ++column) {
      const float x = 0.5F * static_cast<float>(column) + jitter(random);
      const float y = 0.5F * static_cast<float>(row) + jitter(random);
      points.emplace_back(x, y, height(x, y) + noise * error(random));
    }
  }
  return points;
}

double degreesBetween(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  // The chord tells small angles that a float's cosine does not.
  const double chord = (a.cast<double>().normalized() - b.cast<double>().normalized()).norm();
  return 2.0 * std::asin(0.5 * chord) / kRadiansPerDegree;
}

TEST(LocalSurfaces, APlaneIsFoundExactly) {
  // 0.3 east, -0.2 north: normal (-0.3, 0.2, 1).
  const Points points = field([](float x, float y) { return 0.3F * x - 0.2F * y + 100.0F; });
  const LocalSurfaces surfaces(points, LocalSurfaceSettings());
  for (std::size_t i = 0; i < points.size(); i += 7) {
    if (points[i].head<2>().cwiseAbs().maxCoeff() > 13.0F) continue;  // corners have few neighbours
    const LocalSurface surface = surfaces.at(points[i]);
    ASSERT_TRUE(surface.found());
    // Floats of 100 m have steps of 8e-6 m; over a metre that is 5e-4 degrees.
    EXPECT_LT(degreesBetween(surface.normal, {-0.3F, 0.2F, 1.0F}), 2e-3);
    EXPECT_LT(surface.roughness, 1e-4F);
  }
}

TEST(LocalSurfaces, NoiseTurnsThePlaneByWhatLeastSquaresAllows) {
  // 16 points within 1.1 m: spread about 0.55 m per axis, so 0.02 / (0.55 sqrt(16)) = 0.0091 rad
  // per axis, 0.74 degrees in both; mean of the Rayleigh distribution 0.0091 * 1.2533 = 0.65
  // degrees.
  const Points points = field([](float, float) { return 0.0F; }, 0.02F);
  const LocalSurfaces surfaces(points, LocalSurfaceSettings());
  double sum = 0.0;
  int count = 0;
  for (const Eigen::Vector3f& point : points) {
    if (point.head<2>().cwiseAbs().maxCoeff() > 13.0F) continue;
    const LocalSurface surface = surfaces.at(point);
    ASSERT_TRUE(surface.found());
    sum += degreesBetween(surface.normal, Eigen::Vector3f::UnitZ());
    ++count;
  }
  EXPECT_NEAR(sum / count, 0.65, 0.15);
}

TEST(LocalSurfaces, PointsNearARidgeTakeTheirOwnSide) {
  // A gable of 40 degrees: slopes of tan 40 either side of x = 0.
  const float tangent = std::tan(40.0F * static_cast<float>(kRadiansPerDegree));
  const Points points = field([tangent](float x, float) { return -tangent * std::abs(x); }, 0.01F);
  const LocalSurfaces surfaces(points, LocalSurfaceSettings());
  int wrong = 0, count = 0;
  for (const Eigen::Vector3f& point : points) {
    // Nearer than the tolerance to the other side's plane a point may lie on either.
    if (std::abs(point.x()) < 0.15F || std::abs(point.x()) > 1.0F || std::abs(point.y()) > 13.0F)
      continue;
    const LocalSurface surface = surfaces.at(point);
    const Eigen::Vector3f normal(point.x() > 0.0F ? tangent : -tangent, 0.0F, 1.0F);
    ++count;
    wrong += !surface.found() || degreesBetween(surface.normal, normal) > 8.0 ? 1 : 0;
  }
  ASSERT_GT(count, 100);
  EXPECT_LT(wrong, count / 20);
}

TEST(LocalSurfaces, RoofEdgesAreNotRoundedOff) {
  // Ground at 0, a flat roof at 6 m for x > 0: least squares alone would see a wall of 60 degrees.
  const Points points = field([](float x, float) { return x > 0.0F ? 6.0F : 0.0F; }, 0.02F);
  const LocalSurfaces surfaces(points, LocalSurfaceSettings());
  int wrong = 0, count = 0;
  for (const Eigen::Vector3f& point : points) {
    if (std::abs(point.x()) > 1.0F || std::abs(point.y()) > 13.0F) continue;
    const LocalSurface surface = surfaces.at(point);
    ++count;
    wrong += surface.found() && degreesBetween(surface.normal, Eigen::Vector3f::UnitZ()) > 8.0;
  }
  ASSERT_GT(count, 100);
  EXPECT_LT(wrong, count / 20);
}

TEST(LocalSurfaces, ARowOnARoofAndOneOnTheGroundAreNoSlope) {
  // Scan lines 3 m apart, one on a narrow roof of 4 m: with its neighbour on the ground it spans a
  // plane of atan(4 / 3) = 53 degrees that holds 12 of 15 points.
  Points points;
  for (int row = -5; row <= 5; ++row)
    for (int column = -20; column <= 20; ++column)
      points.emplace_back(0.7F * static_cast<float>(column), 3.0F * static_cast<float>(row),
                          row == 0 ? 4.0F : 0.0F);
  LocalSurfaceSettings settings;
  settings.radius = 3.25;
  const LocalSurfaces surfaces(points, settings);
  EXPECT_FALSE(surfaces.at({0.0F, 0.0F, 4.0F}).found());
  // A slope as steep with rows half as far apart is one: rows at -3, -1.5, 0, 1.5 and 3 m.
  Points slope;
  for (int row = -10; row <= 10; ++row)
    for (int column = -20; column <= 20; ++column)
      slope.emplace_back(0.7F * static_cast<float>(column), 1.5F * static_cast<float>(row),
                         2.0F * static_cast<float>(row));
  const LocalSurface found = LocalSurfaces(slope, settings).at({0.0F, 0.0F, 0.0F});
  ASSERT_TRUE(found.found());
  EXPECT_NEAR(degreesBetween(found.normal, Eigen::Vector3f::UnitZ()), 53.13, 1e-2);
}

TEST(LocalSurfaces, LeavesHaveNone) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-5.0F, 5.0F);
  Points crown;
  for (int i = 0; i < 1000; ++i) crown.emplace_back(place(random), place(random), place(random));
  const LocalSurfaces surfaces(crown, LocalSurfaceSettings());
  int found = 0;
  for (const Eigen::Vector3f& point : crown) found += surfaces.at(point).found();
  EXPECT_LT(found, 20);
}

TEST(LocalSurfaces, LinesAndLonePointsHaveNone) {
  Points wire;
  for (int i = 0; i < 100; ++i) wire.emplace_back(0.2F * static_cast<float>(i), 0.0F, 10.0F);
  const LocalSurfaces surfaces(wire, LocalSurfaceSettings());
  EXPECT_FALSE(surfaces.at(wire[50]).found());
  const LocalSurfaces lone({{0.0F, 0.0F, 0.0F}}, LocalSurfaceSettings());
  EXPECT_FALSE(lone.at({0.0F, 0.0F, 0.0F}).found());
  EXPECT_FALSE(LocalSurfaces({}, LocalSurfaceSettings()).at({0.0F, 0.0F, 0.0F}).found());
  const Points points = field([](float, float) { return 0.0F; });
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(LocalSurfaces(points, LocalSurfaceSettings()).at({nan, 0.0F, 0.0F}).found());
  EXPECT_FALSE(LocalSurfaces(points, LocalSurfaceSettings()).at({1e6F, 1e6F, 0.0F}).found());
}

TEST(LocalSurfaces, OrderOfPointsChangesNothing) {
  Points points = field([](float x, float y) { return std::sin(0.3F * x) + 0.1F * y; }, 0.03F);
  const LocalSurfaces first(points, LocalSurfaceSettings());
  std::vector<LocalSurface> before;
  for (const Eigen::Vector3f& point : points) before.push_back(first.at(point));
  Points shuffled = points;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(5));
  const LocalSurfaces second(shuffled, LocalSurfaceSettings());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LocalSurface after = second.at(points[i]);
    ASSERT_EQ(before[i].support, after.support);
    if (after.found()) {
      ASSERT_EQ(before[i].normal, after.normal);
    }
  }
}

TEST(LocalSurfaces, TheRadiusHoldsSixteenPoints) {
  // 4 points per m2: 16 / (4 pi) = 1.128^2; border cells of 4 m are partly empty: some per cent.
  const Points points = field([](float, float) { return 0.0F; });
  EXPECT_NEAR(LocalSurfaces::radiusFor(points), 1.13, 0.1);
}

TEST(LocalSurfaces, RefusesImpossibleSettings) {
  LocalSurfaceSettings settings;
  settings.tolerance = 0.0;
  EXPECT_THROW(LocalSurfaces({}, settings), UsageError);
  settings = LocalSurfaceSettings();
  settings.radius = NAN;
  EXPECT_THROW(LocalSurfaces({}, settings), UsageError);
  settings = LocalSurfaceSettings();
  settings.most_points = 100;
  EXPECT_THROW(LocalSurfaces({}, settings), UsageError);
}

}  // namespace
}  // namespace pcl_als
