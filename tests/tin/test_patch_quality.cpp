// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/tin/orientation_classes.h>
#include <pcl_als/tin/patch_surface.h>
#include <pcl_als/tin/surface_criterion.h>

#include "surface_sets.h"

namespace pcl_als {
namespace {

using Eigen::Vector3d;

PatchQuality qualityAt(const PatchSurface& surface, double x, double y) {
  return surface.quality(surface.tin().locate(x, y));
}

TEST(PatchQuality, TiltedPlaneByHand) {
  // z = 0.75 y over a grid of 1 m: triangles 1, 1.25 and sqrt(1 + 1.25^2) m.
  const PatchSurface surface(Tin(test::planePoints(0.0, 0.75, 10.0, 1.0)));
  const PatchQuality q = qualityAt(surface, 5.3, 5.4);
  EXPECT_NEAR(q.longest_edge, std::sqrt(1.0 + 1.25 * 1.25), 1e-6);  // float
  EXPECT_NEAR(q.slope, std::atan(0.75), 1e-6);
  EXPECT_NEAR(q.roughness, 0.0, 1e-7);  // the eigenvector is good to 1e-8, over metres
  EXPECT_NEAR(q.bend, 0.0, 1e-7);
  EXPECT_FALSE(q.on_hull);
  // All diagonals of a tied grid run one way: three rings of six around a triangle hold 12 points.
  EXPECT_EQ(q.vertices, 12);
}

TEST(PatchQuality, SuitableTrianglesAreThoseThatSatisfyTheCriterion) {
  const PatchSurface surface(Tin(test::scenePoints(5000, 0.02, 5)));
  const double median_edge = typicalPlanEdge(surface.tin());
  SurfaceCriterion bent, any;
  bent.bend = 0.2;
  bent.slope = 0.4;
  any.edge_factor = any.slope = any.roughness = std::numeric_limits<double>::infinity();
  any.minimum_vertices = 0;
  any.reject_border = false;
  for (const SurfaceCriterion& criterion : {SurfaceCriterion(), bent, any}) {
    std::size_t suitable = 0;
    for (std::size_t t = 0; t < surface.tin().triangles().size(); ++t) {
      const auto triangle = static_cast<std::int32_t>(t);
      const PatchQuality quality = surface.quality(triangle);
      const auto found = surface.suitable(triangle, criterion, median_edge);
      ASSERT_EQ(found.has_value(), criterion.isSatisfiedBy(quality, median_edge));
      if (!found) continue;
      ++suitable;
      EXPECT_EQ(found->plane_normal, quality.plane_normal);
      EXPECT_EQ(found->plane_centre, quality.plane_centre);
      EXPECT_EQ(found->roughness, quality.roughness);
      EXPECT_EQ(found->slope, quality.slope);
      EXPECT_EQ(found->spread, quality.spread);
    }
    EXPECT_GT(suitable, surface.tin().triangles().size() / 20);
  }
}

TEST(OrientationClasses, AreSlopeStepsAndEighthsOfATurn) {
  EXPECT_EQ(OrientationClasses::of(Vector3d::UnitZ()), 0U);
  EXPECT_EQ(OrientationClasses::of(Vector3d(std::tan(0.08), 0.0, 1.0)), 0U);
  const double slopes[] = {0.1, 0.4, 0.8};  // radians
  for (std::size_t step = 0; step < 3; ++step) {
    for (int degree = 0; degree < 360; ++degree) {
      const double azimuth = degree * kRadiansPerDegree, rise = std::tan(slopes[step]);
      // Eighths are counted from 0.1234 rad (7.07 degrees) before west, counter-clockwise.
      const int aspect = static_cast<int>(std::fmod(degree + 180.0 + 7.0703, 360.0) / 45.0);
      EXPECT_EQ(OrientationClasses::of({rise * std::cos(azimuth), rise * std::sin(azimuth), 1.0}),
                1 + 8 * step + static_cast<std::size_t>(aspect))
          << degree;
    }
  }
}

TEST(TypicalPlanEdge, IsTheMedianOfAGrid) {
  EXPECT_EQ(typicalPlanEdge(Tin()), 0.0);
  // Edges of 1, 1 and 1.41421 m.
  EXPECT_NEAR(typicalPlanEdge(Tin(test::planePoints(0.0, 0.0, 20.0, 1.0))), 1.0, 1e-9);
}

TEST(TypicalPlanEdge, ClustersDoNotSetTheScaleOfTheGapsBetweenThem) {
  // 800 triangles of 1 m and 1,800 of 0.1 m: the median edge is 0.1 m, while seven tenths of the
  // plane, and more than a tenth of the triangles, have edges of 1 and 1.41421 m.
  std::vector<Vector3d> points;
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j) points.emplace_back(i, j, 0.0);
  for (int i = 0; i <= 30; ++i)
    for (int j = 0; j <= 30; ++j) points.emplace_back(8.05 + 0.1 * i, 8.05 + 0.1 * j, 0.0);
  EXPECT_NEAR(typicalPlanEdge(Tin(points)), 1.41421 / 2.3, 0.01);
}

TEST(PatchQuality, BorderIsMarkedAndOnlyThere) {
  const PatchSurface surface(Tin(test::planePoints(0.1, 0.2, 10.0, 1.0)));
  for (std::size_t t = 0; t < surface.tin().triangles().size(); ++t) {
    bool at_border = false;
    for (const std::int32_t v : surface.tin().triangles()[t].vertex) {
      const Vector3d& p = surface.tin().points()[v];
      at_border = at_border || p.x() == 0.0 || p.y() == 0.0 || p.x() == 10.0 || p.y() == 10.0;
    }
    EXPECT_EQ(surface.quality(static_cast<std::int32_t>(t)).on_hull, at_border) << t;
  }
}

TEST(PatchQuality, OneTriangleIsItsOwnNeighbourhood) {
  const PatchQuality q = PatchSurface(Tin({{0, 0, 0}, {3, 0, 4}, {0, 2, 0}})).quality(0);
  EXPECT_EQ(q.vertices, 3);
  EXPECT_TRUE(q.on_hull);
  EXPECT_NEAR(q.longest_edge, std::sqrt(29.0), 1e-6);
  EXPECT_NEAR(q.roughness, 0.0, 1e-7);
}

TEST(PatchQuality, RoughnessIsTheNoise) {
  // 2 cm of noise on about 12 vertices less 3 of the plane: RMS expected 0.02 sqrt(9 / 12).
  const PatchSurface surface(Tin(test::scenePoints(40000, 0.02, 1)));
  double sum = 0.0;
  int count = 0;
  for (double x = 40.0; x < 45.0; x += 0.1)
    for (double y = 37.0; y < 43.0; y += 0.1, ++count) sum += qualityAt(surface, x, y).roughness;
  EXPECT_NEAR(sum / count, 0.02 * std::sqrt(0.75), 0.002);  // rings hold 10 to 15 vertices
}

TEST(PatchQuality, WallsAndEavesStandOutFromRoofAndGround) {
  const PatchSurface surface(Tin(test::scenePoints(40000, 0.02, 2)));
  int walls = 0;
  for (std::size_t t = 0; t < surface.tin().triangles().size(); ++t) {
    const auto& v = surface.tin().triangles()[t].vertex;
    double low = 1e9, high = -1e9;
    for (const std::int32_t i : v) {
      low = std::min(low, surface.tin().points()[i].z());
      high = std::max(high, surface.tin().points()[i].z());
    }
    if (high - low < 4.0) continue;  // all walls are higher than that, nothing else is
    ++walls;
    const PatchQuality q = surface.quality(static_cast<std::int32_t>(t));
    EXPECT_GT(q.longest_edge, 4.0F);
    EXPECT_GT(q.slope, 1.2F);
    EXPECT_GT(q.roughness, 0.05F);  // the plane of a wall's neighbourhood stands up; noise is 0.02
  }
  EXPECT_GT(walls, 300);
  const PatchQuality roof = qualityAt(surface, 18.0, 20.0), ground = qualityAt(surface, 5.0, 50.0);
  for (const PatchQuality& q : {roof, ground}) {
    EXPECT_LT(q.longest_edge, 2.0F);
    EXPECT_LT(q.roughness, 0.05F);
    EXPECT_LT(q.bend, 0.5F);
  }
  EXPECT_NEAR(roof.slope, std::atan(0.6), 0.3);  // one triangle of 0.3 m in 2 cm of noise
}

TEST(PatchQuality, ARidgeBendsAndItsSlopesDoNot) {
  const PatchSurface surface(Tin(test::scenePoints(40000, 0.0, 3)));
  double ridge = 0.0;
  for (double y = 12.0; y < 28.0; y += 0.1)
    ridge = std::max<double>(ridge, qualityAt(surface, 20.05, y).bend);
  EXPECT_GT(ridge, 0.2);  // half the angle between the slopes is 0.54
  EXPECT_LT(qualityAt(surface, 17.5, 20.0).bend, 1e-6);
}

TEST(PatchQuality, SameAfterTurningAboutTheVertical) {
  // Nothing but rounding distinguishes directions in plan.
  std::vector<Vector3d> points = test::scenePoints(3000, 0.02, 4);
  const PatchSurface a{Tin(points)};
  for (Vector3d& p : points) p = Vector3d(-p.y(), p.x(), p.z());
  const PatchSurface b{Tin(points)};
  for (double x = 2.0; x < 58.0; x += 1.7) {
    const PatchQuality p = qualityAt(a, x, 20.3), q = qualityAt(b, -20.3, x);
    EXPECT_EQ(p.vertices, q.vertices);
    EXPECT_NEAR(p.roughness, q.roughness, 1e-6 * (1.0 + p.roughness));
    EXPECT_NEAR(p.bend, q.bend, 1e-5);
    EXPECT_NEAR(p.slope, q.slope, 1e-5);
  }
}

}  // namespace
}  // namespace pcl_als
