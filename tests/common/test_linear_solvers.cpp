// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {
namespace {

/// A symmetric matrix with these eigenvalues, in a random orientation.
Eigen::Matrix3d matrixWith(const Eigen::Vector3d& values, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
          .normalized();
  const Eigen::Matrix3d axes = turn.toRotationMatrix();
  return axes * values.asDiagonal() * axes.transpose();
}

/// Scatters of points near a plane, whose least eigenvalue is 1e-4 to 1e-8 of the others.
TEST(LeastEigen3, AgreesWithIterations) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.5, 2.0), exponent(-8.0, -4.0);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d values(std::pow(10.0, exponent(random)), uniform(random),
                                 uniform(random));
    const Eigen::Matrix3d matrix = matrixWith(values, random);
    const LeastEigen3 least = leastEigen3(matrix);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> expected(matrix);
    EXPECT_NEAR(least.value, expected.eigenvalues()[0], 1e-14);
    // Half of the digits remain where the two larger values are nearly equal.
    EXPECT_NEAR(least.middle_value, expected.eigenvalues()[1], 1e-7);
    EXPECT_NEAR(std::abs(least.vector.dot(expected.eigenvectors().col(0))), 1.0, 1e-14);
    EXPECT_NEAR(least.vector.norm(), 1.0, 1e-14);
  }
}

TEST(LeastEigen3, OfPointsOnALineIsPerpendicularToIt) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d matrix = matrixWith({0.0, 0.0, 3.0}, random);
    const LeastEigen3 least = leastEigen3(matrix);
    EXPECT_NEAR(least.value, 0.0, 1e-7);
    EXPECT_NEAR(least.vector.norm(), 1.0, 1e-14);
    EXPECT_NEAR((matrix * least.vector).norm(), 0.0, 1e-6);
  }
}

TEST(LeastEigen3, OfEqualValuesIsAnyUnitVector) {
  for (const double value : {0.0, 2.0}) {
    const LeastEigen3 least = leastEigen3(value * Eigen::Matrix3d::Identity());
    EXPECT_EQ(least.value, value);
    EXPECT_EQ(least.middle_value, value);
    EXPECT_EQ(least.vector.norm(), 1.0);
  }
}

}  // namespace
}  // namespace pcl_als
