// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/coordinate_steps.h>

namespace pcl_als {
namespace {

/// Points of 300 m of a strip over ground with a relief of some metres.
std::vector<Eigen::Vector3d> somePoints(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 300.0 * uniform(random), y = 60.0 * uniform(random);
    points.emplace_back(690000.0 + x, 5330000.0 + y, 500.0 + 3.0 * std::sin(0.02 * (x + y)));
  }
  return points;
}

void roundTo(double step, int axis, std::vector<Eigen::Vector3d>& points) {
  for (Eigen::Vector3d& point : points) point[axis] = step * std::round(point[axis] / step);
}

TEST(CoordinateSteps, ThoseOfASinglePrecision) {
  std::vector<Eigen::Vector3d> points = somePoints(kEnoughForSteps);
  for (Eigen::Vector3d& point : points) point = point.cast<float>().cast<double>();
  for (int axis = 0; axis < 3; ++axis) roundTo(0.001, axis, points);  // as written to a file
  const Eigen::Vector3d steps = coordinateSteps(points);
  EXPECT_NEAR(steps.x(), 0.0625, 0.001);
  EXPECT_NEAR(steps.y(), 0.5, 1e-6);
  EXPECT_LT(steps.z(), 0.0011);
  EXPECT_EQ(describeSteps(steps, Eigen::Vector3d::Constant(0.002)),
            "0.062 m (east), 0.5 m (north)");
}

TEST(CoordinateSteps, ThoseOfAScale) {
  for (const double step : {0.01, 0.1, 0.25}) {
    std::vector<Eigen::Vector3d> points = somePoints(kEnoughForSteps);
    for (int axis = 0; axis < 3; ++axis) roundTo(step, axis, points);
    const Eigen::Vector3d steps = coordinateSteps(points);
    if (step >= 0.1) {
      EXPECT_NEAR(steps.x(), step, 1e-6);
      EXPECT_NEAR(steps.y(), step, 1e-6);
    }
    EXPECT_TRUE(steps.z() == 0.0 || std::abs(steps.z() - step) < 1e-6) << steps.z();
  }
}

TEST(CoordinateSteps, AScanLineHasNone) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 500; ++i) points.emplace_back(0.25 * i, 0.1 * i, 500.0 + 0.01 * i);
  EXPECT_TRUE(coordinateSteps(points).isZero(0.0));
}

/// The scale of the file, or nothing: never a step that is not there.
TEST(CoordinateSteps, NoneWhereThereAreNone) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{50}, std::size_t{500},
                                  std::size_t{5000}, kEnoughForSteps}) {
    std::vector<Eigen::Vector3d> points = somePoints(count);
    EXPECT_LT(coordinateSteps(points).maxCoeff(), 1e-4) << count;
    for (int axis = 0; axis < 3; ++axis) roundTo(0.001, axis, points);
    EXPECT_LT(coordinateSteps(points).maxCoeff(), 0.0011) << count;
  }
}

}  // namespace
}  // namespace pcl_als
