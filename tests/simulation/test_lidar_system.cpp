// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <pcl_als/simulation/lidar_system.h>

namespace {

using namespace pcl_als;
using namespace pcl_als::simulation;

constexpr double kHundredArcsec = 4.848137e-4;  // radians

// Level flight at 1000 m over the origin. The beam of the oblique shot meets x = 500 m right of the
// line, z = -1000 m: r = sqrt(500^2 + 1000^2) = 1118.033989 m, beta = -atan(0.5) = -0.463647609.
constexpr double kObliqueRange = 1118.0339887;
constexpr double kObliqueAngle = -0.4636476090;

Pose levelPose(double heading_degrees) {
  Pose pose;
  pose.position = {0.0, 0.0, 1000.0};
  pose.heading = heading_degrees * kRadiansPerDegree;
  return pose;
}

/// Displacement of the point when one parameter is assumed wrong by delta and all are truly zero.
Eigen::Vector3d effect(SystemParameter parameter, double delta, double heading_degrees,
                       double angle, double range) {
  SystemVector assumed = SystemVector::Zero();
  assumed[indexOf(parameter)] = delta;
  const Pose pose = levelPose(heading_degrees);
  return LidarSystem(assumed).groundPoint(pose, angle, range) -
         LidarSystem(SystemVector::Zero()).groundPoint(pose, angle, range);
}

Eigen::Vector3d obliqueEffect(SystemParameter parameter, double delta, double heading = 0.0) {
  return effect(parameter, delta, heading, kObliqueAngle, kObliqueRange);
}

// The neglected second order of 100 arcsec at 1118 m: 1118 * (4.85e-4)^2 = 2.6e-4 m.
constexpr double kSecondOrder = 3e-4;

void expectNear(const Eigen::Vector3d& actual, double east, double north, double up,
                double tolerance) {
  EXPECT_NEAR(actual.x(), east, tolerance);
  EXPECT_NEAR(actual.y(), north, tolerance);
  EXPECT_NEAR(actual.z(), up, tolerance);
}

TEST(LidarSystem, ObliqueBeamMeetsTheGroundOnTheRight) {
  const LidarSystem system(SystemVector::Zero());
  expectNear(system.groundPoint(levelPose(0.0), kObliqueAngle, kObliqueRange), 500.0, 0.0, 0.0,
             1e-6);  // the ten digits of range and angle
  // Flying east, right is south.
  expectNear(system.groundPoint(levelPose(90.0), kObliqueAngle, kObliqueRange), 0.0, -500.0, 0.0,
             1e-6);
}

TEST(LidarSystem, PositiveRollPutsTheRightWingDown) {
  // Five degrees: nadir beam swings to the left, 1000 m * sin(5 deg) = 87.1557 m.
  Pose pose = levelPose(0.0);
  pose.roll = 5.0 * kRadiansPerDegree;
  const LidarSystem system(SystemVector::Zero());
  expectNear(system.groundPoint(pose, 0.0, 1000.0), -87.1557427, 0.0, 3.8053019, 1e-6);
}

TEST(LidarSystem, PositivePitchPutsTheNoseUp) {
  // Two degrees: nadir beam swings forward, 1000 m * sin(2 deg) = 34.8995 m; flying north.
  Pose pose = levelPose(0.0);
  pose.pitch = 2.0 * kRadiansPerDegree;
  const LidarSystem system(SystemVector::Zero());
  expectNear(system.groundPoint(pose, 0.0, 1000.0), 0.0, 34.8994967, 0.6091730, 1e-6);
}

TEST(LidarSystem, HeadingTurnsClockwise) {
  const Eigen::Vector3d forward =
      groundFromBody(0.0, 0.0, 30.0 * kRadiansPerDegree) * Eigen::Vector3d::UnitY();
  expectNear(forward, 0.5, 0.8660254038, 0.0, 1e-9);
}

TEST(LidarSystem, LeverArmTurnsWithTheAircraft) {
  expectNear(obliqueEffect(SystemParameter::lever_arm_x, 0.05), 0.05, 0.0, 0.0, 1e-12);
  expectNear(obliqueEffect(SystemParameter::lever_arm_y, 0.05), 0.0, 0.05, 0.0, 1e-12);
  expectNear(obliqueEffect(SystemParameter::lever_arm_z, 0.05), 0.0, 0.0, 0.05, 1e-12);
  // Flying east: right is south, forward is east.
  expectNear(obliqueEffect(SystemParameter::lever_arm_x, 0.05, 90.0), 0.0, -0.05, 0.0, 1e-12);
  expectNear(obliqueEffect(SystemParameter::lever_arm_y, 0.05, 90.0), 0.05, 0.0, 0.0, 1e-12);
}

TEST(LidarSystem, BoresightPitchMovesAlongTheFlight) {
  // North: dY = -z dw = 1000 * 4.848137e-4. East: dX = s z dw = (-1)(-1000) dw.
  expectNear(obliqueEffect(SystemParameter::boresight_pitch, kHundredArcsec), 0.0, 0.4848137, 0.0,
             kSecondOrder);
  expectNear(obliqueEffect(SystemParameter::boresight_pitch, kHundredArcsec, 90.0), 0.4848137, 0.0,
             0.0, kSecondOrder);
}

TEST(LidarSystem, BoresightRollMovesAcrossAndTilts) {
  // Nadir, north: dX = z df = -0.4848137. Oblique: also dZ = -x df = -0.2424069.
  expectNear(effect(SystemParameter::boresight_roll, kHundredArcsec, 0.0, 0.0, 1000.0), -0.4848137,
             0.0, 0.0, kSecondOrder);
  expectNear(obliqueEffect(SystemParameter::boresight_roll, kHundredArcsec), -0.4848137, 0.0,
             -0.2424069, kSecondOrder);
  // East: dY = s z df = (-1)(-1000) df.
  expectNear(obliqueEffect(SystemParameter::boresight_roll, kHundredArcsec, 90.0), 0.0, 0.4848137,
             -0.2424069, kSecondOrder);
}

TEST(LidarSystem, BoresightHeadingMovesAlongInProportionToX) {
  // North: dY = x dk = 500 * 4.848137e-4. East: dX = -s x dk. Nothing at nadir.
  expectNear(obliqueEffect(SystemParameter::boresight_heading, kHundredArcsec), 0.0, 0.2424069, 0.0,
             kSecondOrder);
  expectNear(obliqueEffect(SystemParameter::boresight_heading, kHundredArcsec, 90.0), 0.2424069,
             0.0, 0.0, kSecondOrder);
  expectNear(effect(SystemParameter::boresight_heading, kHundredArcsec, 0.0, 0.0, 1000.0), 0.0, 0.0,
             0.0, 1e-12);
}

TEST(LidarSystem, RangeBiasLengthensTheBeam) {
  // sin b = -0.4472136, cos b = 0.8944272: dX = -sin(b) dr, dZ = -cos(b) dr, dr = 0.12.
  expectNear(obliqueEffect(SystemParameter::range_bias, 0.12), 0.0536656, 0.0, -0.1073313, 1e-7);
}

TEST(LidarSystem, ScanAngleScaleWidensTheSwath) {
  // dX = z b dS = (-1000)(-0.4636476) 1e-4, dZ = -x b dS = -500 (-0.4636476) 1e-4.
  // Second order: 1118 * (0.46e-4)^2 = 2e-6 m.
  expectNear(obliqueEffect(SystemParameter::scan_angle_scale, 1e-4), 0.0463648, 0.0, 0.0231824,
             3e-6);
}

TEST(LidarSystem, RotationsAreProper) {
  const Eigen::Matrix3d m = groundFromBody(0.1, -0.2, 2.5);
  EXPECT_NEAR((m * m.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-14);
  EXPECT_NEAR(m.determinant(), 1.0, 1e-14);
}

TEST(LidarSystem, TrueSystemReturnsToWhereTheBeamWent) {
  SystemVector parameters;
  parameters << 0.1, -0.2, 0.3, 1e-3, -2e-3, 3e-3, 0.5, 1e-3;
  const LidarSystem system(parameters);
  Pose pose = levelPose(33.0);
  pose.roll = 0.02;
  const Eigen::Matrix3d rotation = groundFromBody(pose.roll, pose.pitch, pose.heading);
  const Eigen::Vector3d target =
      system.firingPoint(pose.position, rotation) + 950.0 * system.direction(rotation, 0.2);
  const Eigen::Vector3d point = system.groundPoint(pose, 0.2, system.measuredRange(950.0));
  EXPECT_NEAR((point - target).norm(), 0.0, 1e-10);  // rounding at 1000 m
  EXPECT_DOUBLE_EQ(system.measuredRange(950.0), 949.5);
}

}  // namespace
