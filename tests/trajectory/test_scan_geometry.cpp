// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {
namespace {

/// Rz(kappa), written out.
Eigen::Matrix3d turnedBy(double cos_kappa, double sin_kappa) {
  Eigen::Matrix3d rotation;
  rotation << cos_kappa, -sin_kappa, 0.0, sin_kappa, cos_kappa, 0.0, 0.0, 0.0, 1.0;
  return rotation;
}

SensorPose poseAlong(double east, double north) {
  SensorPose pose;
  pose.position = Eigen::Vector3d(1000.0, 2000.0, 1500.0);
  const double length = std::hypot(east, north);
  pose.rotation = turnedBy(north / length, -east / length);
  return pose;
}

TEST(ScanGeometry, RightOfFlightIsPositiveForTheFourCourses) {
  const struct {
    double east, north, right_east, right_north;
  } courses[] = {{0, 1, 1, 0}, {1, 0, 0, -1}, {0, -1, -1, 0}, {-1, 0, 0, 1}};
  for (const auto& course : courses) {
    const SensorPose pose = poseAlong(course.east, course.north);
    // 100 m to the right, 30 m ahead (a skewed scan pose), 1000 m below.
    const Eigen::Vector3d point =
        pose.position + Eigen::Vector3d(100.0 * course.right_east + 30.0 * course.east,
                                        100.0 * course.right_north + 30.0 * course.north, -1000.0);
    const ScanGeometry geometry = scanGeometry(pose, point);
    EXPECT_NEAR(geometry.x, 100.0, 1e-9);
    EXPECT_NEAR(geometry.z, -1000.0, 1e-9);
    EXPECT_NEAR(geometry.beta, -std::atan(0.1), 1e-12);
  }
}

TEST(ScanGeometry, BetaHasTheSignOfEquation2) {
  const SensorPose pose = poseAlong(3.0, -4.0);
  for (const double angle : {-170.0, -91.0, -20.0, 0.0, 33.0, 90.0, 120.0}) {
    const double beta = angle * kRadiansPerDegree;
    const Eigen::Vector3d point =
        pose.position + Eigen::Vector3d(-500.0 * std::sin(beta) * -0.8,
                                        -500.0 * std::sin(beta) * -0.6, -500.0 * std::cos(beta));
    const ScanGeometry geometry = scanGeometry(pose, point);
    EXPECT_NEAR(std::sin(geometry.beta - beta), 0.0, 1e-12) << angle;
    // Eq. (2): x = -r sin(beta), z = -r cos(beta).
    EXPECT_NEAR(geometry.x, -500.0 * std::sin(geometry.beta), 1e-9);
    EXPECT_NEAR(geometry.z, -500.0 * std::cos(geometry.beta), 1e-9);
  }
}

TEST(ScanGeometry, APointAtTheSensorHasNoAngle) {
  const SensorPose pose = poseAlong(0.0, 1.0);
  const ScanGeometry geometry = scanGeometry(pose, pose.position);
  EXPECT_EQ(geometry.beta, 0.0);
  EXPECT_TRUE(designBlock(geometry).allFinite());
}

TEST(DesignBlock, EqualsEquation8ByHand) {
  // Forward (-0.8, 0.6): c = 0.6, s = 0.8. A point 300 m right of and 400 m below the sensor.
  SensorPose pose;
  pose.position.setZero();
  pose.rotation = turnedBy(0.6, 0.8);
  const ScanGeometry geometry = scanGeometry(pose, Eigen::Vector3d(180.0, 240.0, -400.0));
  ASSERT_NEAR(geometry.x, 300.0, 1e-12);
  const double beta = -0.64350110879328;  // -atan(3/4); sin -0.6, cos 0.8
  DesignBlock expected;
  expected << 0.6, -0.8, 0.0, -320.0, -240.0, -240.0, 0.36, -240.0 * beta,  //
      0.8, 0.6, 0.0, 240.0, -320.0, 180.0, 0.48, -320.0 * beta,             //
      0.0, 0.0, 1.0, 0.0, -300.0, 0.0, -0.8, -300.0 * beta;
  // 1e-10: the digits of beta above times 320 m.
  EXPECT_LT((designBlock(geometry) - expected).cwiseAbs().maxCoeff(), 1e-10)
      << designBlock(geometry);
}

/// Eq. (2), written out by itself: parameters in the order of SystemParameter, the last one S - 1.
Eigen::Vector3d equation2(double kappa, double range, double beta, const SystemVector& p) {
  const Eigen::Matrix3d heading =
      Eigen::AngleAxisd(kappa, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d lever(p[0], p[1], p[2]);
  Eigen::Matrix3d boresight;
  boresight << 1.0, -p[5], p[4], p[5], 1.0, -p[3], -p[4], p[3], 1.0;
  const double angle = (1.0 + p[7]) * beta;
  const Eigen::Vector3d beam(-(range + p[6]) * std::sin(angle), 0.0,
                             -(range + p[6]) * std::cos(angle));
  return Eigen::Vector3d(400.0, -300.0, 1200.0) + heading * lever + heading * boresight * beam;
}

TEST(DesignBlock, EqualsCentralDifferencesOfEquation2) {
  for (const double kappa : {0.0, 1.0, 2.5, -2.0}) {
    for (const double beta : {-0.4, -0.05, 0.0, 0.3}) {
      const double range = 1300.0;
      SensorPose pose;
      pose.position = Eigen::Vector3d(400.0, -300.0, 1200.0);
      pose.rotation = turnedBy(std::cos(kappa), std::sin(kappa));
      const DesignBlock design =
          designBlock(scanGeometry(pose, equation2(kappa, range, beta, SystemVector::Zero())));
      for (int i = 0; i < kSystemParameterCount; ++i) {
        SystemVector step = SystemVector::Zero();
        step[i] = 1e-4;
        const Eigen::Vector3d difference =
            (equation2(kappa, range, beta, step) - equation2(kappa, range, beta, -step)) / 2e-4;
        // Rounding: 1e3 m * 2e-16 / 1e-4; truncation (only of S): r beta^3 1e-8 / 6.
        EXPECT_LT((design.col(i) - difference).norm(), 1e-6) << i << ' ' << kappa << ' ' << beta;
      }
    }
  }
}

/// A plane whose line is turned by atan(3/4) about the vertical, 3 m forward for 4 m to the right:
/// its normal is (-0.6, 0.8, 0).
TEST(DesignBlock, HasTheScanAngleOfTheScanPlane) {
  const ScanPlanes planes = {{0.6, 0.8, 0.0}, {-0.6, 0.8, 0.0}};
  SensorPose pose;
  pose.position.setZero();
  pose.has_attitude = true;
  pose.planes = &planes;
  const ScanGeometry geometry = scanGeometry(pose, {240.0, 180.0, -400.0});
  EXPECT_EQ(geometry.normal, planes[1]);
  const double beta = -0.64350110879328;  // -atan(300 / 400)
  EXPECT_NEAR(geometry.beta, beta, 1e-14);
  const Eigen::Vector3d expected = beta * Eigen::Vector3d(-320.0, -240.0, -300.0);
  EXPECT_LT(
      (designBlock(geometry).col(indexOf(SystemParameter::scan_angle_scale)) - expected).norm(),
      1e-10);
}

TEST(DesignBlock, EqualsCentralDifferencesOfTheCorrectionInSeveralPlanes) {
  const double tilt = 0.17;
  const ScanPlanes planes = {{0.0, std::cos(tilt), std::sin(tilt)},
                             {0.0, std::cos(tilt), -std::sin(tilt)},
                             {-0.24, std::sqrt(1.0 - 0.24 * 0.24), 0.0}};
  SensorPose pose;
  pose.position = Eigen::Vector3d(400.0, -300.0, 1200.0);
  pose.rotation = turnedBy(std::cos(1.0), std::sin(1.0));
  pose.has_attitude = true;
  pose.planes = &planes;
  for (const Eigen::Vector3d& normal : planes) {
    for (const double beta : {-0.4, -0.05, 0.3}) {
      const Eigen::Vector3d lowest = (normal.z() * normal - Eigen::Vector3d::UnitZ()).normalized();
      const Eigen::Vector3d point =
          pose.position + 1300.0 * (pose.rotation * (Eigen::AngleAxisd(beta, normal) * lowest));
      const DesignBlock design = designBlock(scanGeometry(pose, point));
      for (int i = 0; i < kSystemParameterCount; ++i) {
        const SystemVector step = 1e-4 * SystemVector::Unit(i);
        const Eigen::Vector3d difference =
            (corrected(pose, point, -step) - corrected(pose, point, step)) / 2e-4;
        // Rounding: 1e3 m * 2e-16 / 1e-4; truncation: 1300 m 1e-8 / 6.
        EXPECT_LT((design.col(i) - difference).norm(), 1e-5) << i << ' ' << beta;
      }
    }
  }
}

TEST(DesignBlock, DetectsAWrongSignOfBeta) {
  SensorPose pose = poseAlong(0.0, 1.0);
  ScanGeometry geometry = scanGeometry(pose, pose.position + Eigen::Vector3d(200.0, 0.0, -900.0));
  const DesignBlock right = designBlock(geometry);
  geometry.beta = -geometry.beta;
  EXPECT_GT((designBlock(geometry) - right).norm(), 0.1);
}

}  // namespace
}  // namespace pcl_als
