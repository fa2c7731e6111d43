// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/mounting_convention.h>

namespace pcl_als {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d rows(double a, double b, double c, double d, double e, double f, double g, double h,
              double i) {
  Matrix3d m;
  m << a, b, c, d, e, f, g, h, i;
  return m;
}

void expectEqual(const Matrix3d& a, const Matrix3d& b, double tolerance = 1e-15) {
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), tolerance) << a << "\n\n" << b;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MountingConvention, AxesAreDirectionsOfTheBody) {
  expectEqual(bodyFromAxes("rfu"), Matrix3d::Identity());
  // Forward is y, right is x, down is -z of right, forward, up.
  expectEqual(bodyFromAxes("frd"), rows(0, 1, 0, 1, 0, 0, 0, 0, -1));
  expectEqual(bodyFromAxes("FLU"), rows(0, -1, 0, 1, 0, 0, 0, 0, 1));
  EXPECT_EQ(bodyFromAxes("frd").determinant(), 1.0);
  EXPECT_EQ(bodyFromAxes("fru").determinant(), -1.0);
  for (const char* wrong : {"", "fr", "frdu", "ffd", "fbu", "xyz"})
    EXPECT_NE(refusal([&] { bodyFromAxes(wrong); }).find("are no axes"), std::string::npos)
        << wrong;
}

TEST(MountingConvention, UnitsOfAngles) {
  EXPECT_DOUBLE_EQ(180.0 * radiansPer("deg"), kPi);
  EXPECT_DOUBLE_EQ(200.0 * radiansPer("gon"), kPi);
  EXPECT_DOUBLE_EQ(648000.0 * radiansPer("arcsec"), kPi);
  EXPECT_EQ(radiansPer("rad"), 1.0);
  EXPECT_EQ(refusal([] { radiansPer("mil"); }),
            "'mil' is no unit of angles (deg, rad, gon, arcsec)");
}

// A yaw of 90 degrees turns a scanner clockwise as seen from above: its x axis points to the right,
// which is y of forward, right, down. Then a roll of 90 degrees about this axis turns its y axis,
// which points back, downwards.
TEST(MountingConvention, AerospaceAnglesByHand) {
  const MountingConvention& aerospace = mountingConventionNamed("zyx_frd");
  expectEqual(rotationOf(aerospace, {0, 0, 90}), rows(0, -1, 0, 1, 0, 0, 0, 0, 1));
  expectEqual(rotationOf(aerospace, {90, 0, 90}), rows(0, 0, 1, 1, 0, 0, 0, 1, 0));
  // Pitch 90 degrees: x up (-z), z forward (x).
  expectEqual(rotationOf(aerospace, {0, 90, 0}), rows(0, 0, 1, 0, 1, 0, -1, 0, 0));
}

// The example of Applanix: the x axis of the sensor points to the right of the reference frame.
TEST(MountingConvention, ApplanixByTheExampleOfTheManual) {
  const Matrix3d a = rotationOf(mountingConventionNamed("applanix"), {0, 0, 90});
  EXPECT_LT((a * Vector3d::UnitX() - Vector3d(0, 1, 0)).norm(), 1e-15);  // y is right
}

// The example of NovAtel: 0, 180, 0 turns x and z of the IMU over, y stays. Rotations in the order
// Z, X, Y: with Z = 90 and X = 90, y of the target points first to -x, and then to z.
TEST(MountingConvention, NovatelByTheExampleOfTheManual) {
  const MountingConvention& novatel = mountingConventionNamed("novatel");
  expectEqual(rotationOf(novatel, {0, 180, 0}), rows(-1, 0, 0, 0, 1, 0, 0, 0, -1));
  EXPECT_LT((rotationOf(novatel, {90, 0, 90}).col(1) - Vector3d(0, 0, 1)).norm(), 1e-15);
}

// URDF: first roll about x, then pitch about y, then yaw about z, all fixed axes. A roll of 90
// degrees takes y to z, the yaw leaves it there.
TEST(MountingConvention, RosRotatesAboutFixedAxes) {
  const MountingConvention& ros = mountingConventionNamed("ros");
  const Matrix3d a = rotationOf(ros, {kPi / 2, 0, kPi / 2});
  EXPECT_LT((a.col(1) - Vector3d(0, 0, 1)).norm(), 1e-15);
  MountingConvention fixed = mountingOrder("XYZ", true);
  fixed.unit = "rad";
  expectEqual(rotationOf(fixed, {0.3, -0.7, 2.1}), rotationOf(ros, {0.3, -0.7, 2.1}));
  EXPECT_GT((rotationOf(mountingOrder("XYZ"), {30, 20, 10}) -
             rotationOf(mountingOrder("XYZ", true), {30, 20, 10}))
                .norm(),
            0.05);
}

TEST(MountingConvention, DocumentedOnesAreCompleteAndDistinct) {
  std::set<std::string> names;
  for (const MountingConvention& convention : mountingConventions()) {
    EXPECT_TRUE(names.insert(convention.name).second);
    EXPECT_FALSE(convention.use.empty() || convention.source.empty()) << convention.name;
    EXPECT_EQ(std::set<int>(convention.product.begin(), convention.product.end()).size(), 3U);
    EXPECT_EQ(bodyFromAxes(convention.axes).determinant(), 1.0) << convention.name;
    EXPECT_EQ(&mountingConventionNamed(convention.name), &convention);
  }
  EXPECT_GE(names.size(), 5U);
  EXPECT_EQ(refusal([] { mountingConventionNamed("novatl"); }),
            "unknown convention 'novatl'; did you mean novatel?");
  EXPECT_NE(refusal([] { mountingConventionNamed("unheard"); }).find("zyx_frd, applanix"),
            std::string::npos);
  EXPECT_EQ(describe(mountingConventionNamed("novatel")),
            "Rz(Z) Rx(X) Ry(Y), scanner to body, body axes rfu, deg; lever arm from the body's "
            "origin to the scanner along the axes of the body");
}

TEST(MountingConvention, OrdersThatAreNone) {
  for (const char* wrong : {"", "XY", "XYZX", "XXY", "XYY", "ABC"})
    EXPECT_NE(refusal([&] { mountingOrder(wrong); }).find("is no order"), std::string::npos)
        << wrong;
}

// Angles of every order come back, and so does every rotation, with signs and fixed axes.
TEST(MountingConvention, AnglesComeBack) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-180.0, 180.0);
  int orders = 0;
  for (const char i : {'x', 'y', 'z'}) {
    for (const char j : {'x', 'y', 'z'}) {
      for (const char k : {'x', 'y', 'z'}) {
        if (i == j || j == k) continue;
        ++orders;
        for (int n = 0; n < 200; ++n) {
          MountingConvention convention = mountingOrder({i, j, k}, n % 2 == 0);
          convention.angles[static_cast<std::size_t>(n % 3)].sign = -1;
          const Vector3d typed(angle(random), angle(random), angle(random));
          const Matrix3d rotation = rotationOf(convention, typed);
          const Vector3d found = anglesOf(convention, rotation, typed);
          EXPECT_LT((found - typed).norm(), 1e-9) << i << j << k << ": " << typed.transpose();
          const Vector3d elsewhere(angle(random), angle(random), angle(random));
          expectEqual(rotationOf(convention, anglesOf(convention, rotation, elsewhere)), rotation,
                      2e-15);
        }
      }
    }
  }
  EXPECT_EQ(orders, 12);
}

TEST(MountingConvention, AnglesStayInTheRangeOfTheProgram) {
  const MountingConvention& aerospace = mountingConventionNamed("zyx_frd");
  const Matrix3d turned = rotationOf(aerospace, {0, 0, 180.1});
  EXPECT_NEAR(anglesOf(aerospace, turned, {0, 0, 179.9})[2], -179.9, 1e-12);
  EXPECT_NEAR(anglesOf(aerospace, turned, {0, 0, 200})[2], 180.1, 1e-12);
  const Matrix3d past_zero = rotationOf(aerospace, {0, 0, 0.1});
  EXPECT_NEAR(anglesOf(aerospace, past_zero, {0, 0, 359.9})[2], 0.1, 1e-12);
}

// Near and at gimbal lock the rotation is exact; at it, the first angle of the product stays.
TEST(MountingConvention, GimbalLock) {
  const MountingConvention& aerospace = mountingConventionNamed("zyx_frd");
  EXPECT_NEAR(gimbalSine(aerospace, {10, 30, 20}), std::cos(kPi / 6), 1e-15);
  EXPECT_NEAR(gimbalSine(mountingOrder("ZXZ"), {10, 30, 20}), 0.5, 1e-15);
  for (const double from_lock : {1e-2, 1e-5, 1e-7, 1e-9, 1e-11, 0.0}) {
    const Matrix3d rotation = rotationOf(aerospace, {25, 90 - from_lock, -40});
    expectEqual(rotationOf(aerospace, anglesOf(aerospace, rotation, {1, 89, 2})), rotation,
                kGimbalLock);
  }
  const Vector3d locked = anglesOf(aerospace, rotationOf(aerospace, {25, 90, -40}), {1, 89, 7});
  EXPECT_NEAR(locked[2], 7.0, 1e-12);         // the yaw, first of the product
  EXPECT_NEAR(locked[0], 25.0 + 47.0, 1e-9);  // roll - yaw is all that is determined
}

// The axes of the rotations against differences of the matrix: dA A' = [axes * d]x.
TEST(MountingConvention, AxesOfRotationsByDifferences) {
  for (const bool fixed : {false, true}) {
    MountingConvention convention = mountingOrder("YXZ", fixed);
    convention.unit = "rad";
    convention.angles[1].sign = -1;
    const Vector3d angles(0.4, -1.1, 2.5);
    const Matrix3d axes = rotationAxes(convention, angles);
    for (int i = 0; i < 3; ++i) {
      const double step = 1e-6;
      const Vector3d change = step * Vector3d::Unit(i);
      const Matrix3d turn =
          (rotationOf(convention, angles + change) - rotationOf(convention, angles - change)) /
          (2 * step) * rotationOf(convention, angles).transpose();
      EXPECT_LT((Vector3d(turn(2, 1), turn(0, 2), turn(1, 0)) - axes.col(i)).norm(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace pcl_als
