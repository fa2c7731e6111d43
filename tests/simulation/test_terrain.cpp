// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/simulation/terrain.h>

namespace {

using pcl_als::simulation::Terrain;

Terrain makeTerrain(double relief = 1.0) {
  return Terrain({-600.0, -500.0}, {600.0, 500.0}, relief, 7);
}

/// A beam from 1000 m, up to 35 degrees from the vertical.
struct Beam {
  Eigen::Vector3d origin, direction;
};
Beam randomBeam(std::mt19937& engine) {
  std::uniform_real_distribution<double> place(-100.0, 100.0), slope(-0.5, 0.5);
  const Eigen::Vector3d direction(slope(engine), slope(engine), -1.0);
  return {{place(engine), place(engine), 1000.0}, direction.normalized()};
}

/// First crossing found by small steps and bisection: slow and simple.
double crossingByBisection(const Terrain& terrain, const Beam& beam) {
  const auto above = [&](double range) {
    const Eigen::Vector3d p = beam.origin + range * beam.direction;
    return p.z() - terrain.height(p.x(), p.y());
  };
  double low = 800.0;
  while (above(low + 1.0) > 0.0) low += 1.0;
  double high = low + 1.0;
  for (int i = 0; i < 60; ++i) (above(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

TEST(Terrain, ZeroReliefIsThePlaneZ0) {
  const Terrain terrain = makeTerrain(0.0);
  EXPECT_EQ(terrain.height(123.4, -56.7), 0.0);
  EXPECT_EQ(terrain.maximumSlope(), 0.0);
  EXPECT_NEAR(terrain.intersect({0.0, 0.0, 1000.0}, {0.6, 0.0, -0.8}), 1250.0, 1e-9);
}

TEST(Terrain, GradientIsTheDerivative) {
  const Terrain terrain = makeTerrain();
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> place(-450.0, 450.0);
  for (int i = 0; i < 1000; ++i) {
    const double x = place(engine), y = place(engine), step = 1e-3;
    Eigen::Vector2d gradient;
    terrain.height(x, y, gradient);
    const double east = terrain.height(x + step, y) - terrain.height(x - step, y);
    const double north = terrain.height(x, y + step) - terrain.height(x, y - step);
    // Truncation: step^2 times the third derivative (under 1e-3); rounding: 40 * 1e-16 / 1e-3.
    EXPECT_NEAR(gradient.x(), east / (2.0 * step), 1e-8);
    EXPECT_NEAR(gradient.y(), north / (2.0 * step), 1e-8);
  }
}

TEST(Terrain, SlopeAndHeightBoundsHoldAndAreUsed) {
  const Terrain terrain = makeTerrain();
  double steepest = 0.0;
  for (double y = -500.0; y <= 500.0; y += 3.1)
    for (double x = -600.0; x <= 600.0; x += 3.1) {
      Eigen::Vector2d gradient;
      const double z = terrain.height(x, y, gradient);
      EXPECT_LE(gradient.norm(), terrain.maximumSlope());
      EXPECT_GE(z, terrain.lowest());
      EXPECT_LE(z, terrain.highest());
      steepest = std::max(steepest, gradient.norm());
    }
  EXPECT_GT(steepest, std::tan(15.0 * M_PI / 180.0)) << "no slopes: planimetry cannot be estimated";
  EXPECT_LT(steepest, std::tan(30.0 * M_PI / 180.0));
}

TEST(Terrain, IntersectionEqualsBisection) {
  const Terrain terrain = makeTerrain();
  std::mt19937 engine(2);
  for (int i = 0; i < 500; ++i) {
    const Beam beam = randomBeam(engine);
    // Bisection ends at 1 m / 2^60, below the rounding of 1000 m.
    EXPECT_NEAR(terrain.intersect(beam.origin, beam.direction), crossingByBisection(terrain, beam),
                1e-9);
  }
}

TEST(Terrain, IntersectionLiesOnTheSurface) {
  const Terrain terrain = makeTerrain();
  std::mt19937 engine(3);
  for (int i = 0; i < 20000; ++i) {
    const Beam beam = randomBeam(engine);
    const Eigen::Vector3d p =
        beam.origin + terrain.intersect(beam.origin, beam.direction) * beam.direction;
    EXPECT_NEAR(p.z(), terrain.height(p.x(), p.y()), 1e-9);  // stated in the header
  }
}

TEST(Terrain, NormalIsUnitAndUp) {
  const Terrain terrain = makeTerrain();
  const Eigen::Vector3d normal = terrain.normal(33.0, 44.0);
  EXPECT_NEAR(normal.norm(), 1.0, 1e-15);
  EXPECT_GT(normal.z(), 0.85);
}

TEST(Terrain, WiderSceneKeepsTheShape) {
  const Terrain narrow = makeTerrain();
  const Terrain wide({-900.0, -700.0}, {800.0, 900.0}, 1.0, 7);
  const double shift = wide.height(0.0, 0.0) - narrow.height(0.0, 0.0);
  // The nodes are the same; rounding of the mean height only.
  EXPECT_NEAR(wide.height(200.0, -300.0) - narrow.height(200.0, -300.0), shift, 1e-9);
  EXPECT_NEAR(wide.height(-350.0, 120.0) - narrow.height(-350.0, 120.0), shift, 1e-9);
}

}  // namespace
