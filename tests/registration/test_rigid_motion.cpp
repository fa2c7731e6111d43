// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/registration/rigid_motion.h>

namespace pcl_als {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

RigidMotion someMotion() {
  return {{500'000.0, 5'400'000.0, 300.0}, {0.4, -0.3, 0.2}, {0.01, -0.02, 0.7}, 1.0001};
}

/// Quarter turns by hand: kappa takes east to north, phi takes up to east, omega north to up; of
/// R = Rx Ry Rz the rotation about up comes first.
TEST(RigidMotion, QuarterTurnsByHand) {
  RigidMotion motion;
  motion.centroid = {10.0, 20.0, 30.0};
  motion.rotation = {0.0, 0.0, kPi / 2};
  EXPECT_NEAR((motion.apply({11, 20, 30}) - Vector3d(10, 21, 30)).norm(), 0.0, 1e-14);
  motion.rotation = {0.0, kPi / 2, 0.0};
  EXPECT_NEAR((motion.apply({10, 20, 31}) - Vector3d(11, 20, 30)).norm(), 0.0, 1e-14);
  motion.rotation = {kPi / 2, 0.0, 0.0};
  EXPECT_NEAR((motion.apply({10, 21, 30}) - Vector3d(10, 20, 31)).norm(), 0.0, 1e-14);
  motion.rotation = {kPi / 2, 0.0, kPi / 2};  // east to north, then to up
  EXPECT_NEAR((motion.apply({11, 20, 30}) - Vector3d(10, 20, 31)).norm(), 0.0, 1e-14);
}

TEST(RigidMotion, MatrixAndBack) {
  const RigidMotion motion = someMotion();
  const RigidMotion back = RigidMotion::about(motion.centroid, motion.transformation());
  EXPECT_NEAR((back.shift - motion.shift).norm(), 0.0, 1e-8);  // of coordinates of 5e6 m
  EXPECT_NEAR((back.rotation - motion.rotation).norm(), 0.0, 1e-15);
  EXPECT_NEAR(back.scale, motion.scale, 1e-15);
}

/// Two local frames 3 km apart: no millimetre is lost, as no map coordinate is multiplied.
TEST(RigidMotion, MatrixBetweenLocalFrames) {
  const RigidMotion motion = someMotion();
  const Vector3d from = motion.centroid + Vector3d(1000, -500, 10);
  const Vector3d to = motion.centroid - Vector3d(2000, 700, 0);
  const Vector3d ground = motion.centroid + Vector3d(123.4, 567.8, 9.1);
  const Vector3d local = motion.transformation(from, to) * (ground - from);
  EXPECT_NEAR((local + to - motion.apply(ground)).norm(), 0.0, 2e-9);
}

TEST(RigidMotion, InverseUndoesIt) {
  const RigidMotion motion = someMotion();
  const Vector3d ground = motion.centroid + Vector3d(100, 200, -3);
  EXPECT_NEAR((motion.inverse().apply(motion.apply(ground)) - ground).norm(), 0.0, 1e-9);
}

TEST(RigidMotion, AnglesFollowSmallTurns) {
  const RigidMotion motion = someMotion();
  constexpr double kStep = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    RigidMotion turned[2];
    for (int side = 0; side < 2; ++side) {
      Eigen::Affine3d turn(
          Eigen::AngleAxisd(side == 0 ? kStep : -kStep, Vector3d::Unit(axis)).toRotationMatrix());
      turn.linear() *= motion.rotationMatrix();
      turned[side] = RigidMotion::about(Vector3d::Zero(), turn);
    }
    const Vector3d slope = (turned[0].rotation - turned[1].rotation) / (2.0 * kStep);
    EXPECT_NEAR((slope - motion.anglesFromTurn().col(axis)).norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace pcl_als
