// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "exact_orientation.h"
#include "plan_predicates.h"
#include "tin_verifier.h"

namespace pcl_als {
namespace {

using tin::PlanPoint;

TEST(PlanPredicates, UnitSquareByHand) {
  const PlanPoint a{0, 0}, b{1, 0}, c{1, 1};
  EXPECT_EQ(tin::orientation(a, b, c), 1);
  EXPECT_EQ(tin::orientation(a, c, b), -1);
  EXPECT_EQ(tin::orientation(a, b, {7, 0}), 0);
  EXPECT_FALSE(tin::inCircle(a, b, c, {2, 2}));
  EXPECT_TRUE(tin::inCircle({0, 0}, {4, 0}, {4, 4}, {1, 1}));
}

/// Four points on the circle of radius 5 about (10, 10), counter-clockwise.
constexpr std::array<PlanPoint, 4> kOnCircle{{{15, 10}, {10, 15}, {5, 10}, {7, 6}}};

TEST(PlanPredicates, TieLiftsTheLastPoint) {
  const auto& [last, b, c, d] = kOnCircle;
  EXPECT_FALSE(tin::inCircle(b, c, d, last));  // lifted out of the circle
  EXPECT_TRUE(tin::inCircle(last, b, c, d) ==
              (tin::orientation(d, b, c) > 0));  // the plane rises on last's side of b-c
}

TEST(PlanPredicates, TieIsTheSameForEveryNaming) {
  // Rotating the triangle changes nothing; exactly one diagonal of the four points is Delaunay.
  for (const std::int32_t scale : {1, 1000, 800000}) {
    std::array<PlanPoint, 4> p = kOnCircle;
    for (PlanPoint& q : p) q = {q.x * scale, q.y * scale};
    const bool inside = tin::inCircle(p[0], p[1], p[2], p[3]);
    EXPECT_EQ(tin::inCircle(p[1], p[2], p[0], p[3]), inside);
    EXPECT_EQ(tin::inCircle(p[2], p[0], p[1], p[3]), inside);
    EXPECT_EQ(tin::inCircle(p[2], p[3], p[0], p[1]), inside);
    EXPECT_NE(tin::inCircle(p[1], p[2], p[3], p[0]), inside);
    EXPECT_NE(tin::inCircle(p[0], p[1], p[3], p[2]), inside);
  }
}

TEST(PlanPredicates, TiesOnALargeCircleAreSeenAsTies) {
  // Corners of a circle of radius 65 times an odd number: doubles make the determinant anything but
  // zero. The diagonal that avoids the last point in the order (x, y) is the Delaunay one.
  constexpr std::int32_t kFactor = 129053, kCentre = 8388608;
  const std::vector<std::array<std::int32_t, 2>> turn{
      {65, 0},   {63, 16},   {60, 25},   {56, 33}, {52, 39},  {39, 52},
      {33, 56},  {25, 60},   {16, 63},   {0, 65},  {-16, 63}, {-39, 52},
      {-60, 25}, {-63, -16}, {-33, -56}, {0, -65}, {25, -60}, {56, -33}};  // counter-clockwise
  const auto at = [&](std::size_t i) {
    return PlanPoint{kCentre + turn[i][0] * kFactor, kCentre + turn[i][1] * kFactor};
  };
  const auto before = [](PlanPoint a, PlanPoint b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  for (std::size_t d = 3; d < turn.size(); ++d)
    for (std::size_t c = 2; c < d; ++c)
      for (std::size_t b = 1; b < c; ++b)
        for (std::size_t a = 0; a < b; ++a) {
          const std::array<PlanPoint, 4> p{at(a), at(b), at(c), at(d)};
          const auto last = std::max_element(p.begin(), p.end(), before) - p.begin();
          ASSERT_EQ(tin::inCircle(p[0], p[1], p[2], p[3]), last == 0 || last == 2);
          ASSERT_EQ(tin::inCircle(p[1], p[2], p[3], p[0]), last == 1 || last == 3);
        }
}

TEST(PlanPredicates, InCircleEqualsWholeNumbersWhereItIsHard) {
  // Points next to a large circle: the determinant is tiny against its terms.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0.0, 6.283185307);
  int decided = 0;
  for (int trial = 0; trial < 200000; ++trial) {
    std::array<test::LatticePoint, 4> p{};
    const double radius = trial % 2 == 0 ? 8388000.0 : 300.0;
    for (auto& q : p) {
      const double a = angle(random);
      q = {8388608 + std::llround(radius * std::cos(a)),
           8388608 + std::llround(radius * std::sin(a))};
    }
    if (test::doubledArea(p[0], p[1], p[2]) <= 0) continue;
    const int sign = test::inCircleSign(p[0], p[1], p[2], p[3]);
    const auto plan = [](test::LatticePoint q) {
      return PlanPoint{static_cast<std::int32_t>(q.x), static_cast<std::int32_t>(q.y)};
    };
    if (sign == 0) continue;
    ++decided;
    ASSERT_EQ(tin::inCircle(plan(p[0]), plan(p[1]), plan(p[2]), plan(p[3])), sign > 0);
  }
  EXPECT_GT(decided, 90000);
}

TEST(ExactOrientation, SeesOneUlpFromTheLine) {
  // On the line y = x through large coordinates; one ulp beside it the sign must flip.
  const double a = 583394.123, b = 583894.456;
  for (const double q : {583394.5, 583601.001, 583700.7}) {
    EXPECT_EQ(tin::orientation(a, a, b, b, q, q), 0.0);
    EXPECT_GT(tin::orientation(a, a, b, b, q, std::nextafter(q, 1e9)), 0.0);
    EXPECT_LT(tin::orientation(a, a, b, b, q, std::nextafter(q, 0.0)), 0.0);
    EXPECT_LT(tin::orientation(b, b, a, a, q, std::nextafter(q, 1e9)), 0.0);
  }
}

TEST(ExactOrientation, PlainDoublesGetThatWrong) {
  // What the exact form is for: the naive determinant calls some of these zero or worse.
  const auto naive = [](double ax, double ay, double bx, double by, double qx, double qy) {
    return (ax - qx) * (by - qy) - (ay - qy) * (bx - qx);
  };
  int wrong = 0;
  for (int i = 1; i <= 1000; ++i) {
    const double a = 0.1, b = 24.3 + i, q = 12.7 + i * 0.37, up = std::nextafter(q, 1e9);
    EXPECT_GT(tin::orientation(a, a, b, b, q, up), 0.0);
    wrong += naive(a, a, b, b, q, up) > 0.0 ? 0 : 1;
  }
  EXPECT_GT(wrong, 0);
}

TEST(ExactOrientation, AntisymmetricInItsPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> near(-1e-9, 1e-9);
  for (int i = 0; i < 20000; ++i) {
    const double ax = 1.1, ay = 2.2, bx = 31.1 + near(random), by = 62.2 + near(random);
    const double qx = 16.1 + near(random), qy = 32.2 + near(random);
    const double one = tin::orientation(ax, ay, bx, by, qx, qy);
    ASSERT_EQ(one > 0.0, tin::orientation(bx, by, ax, ay, qx, qy) < 0.0);
    ASSERT_EQ(one > 0.0, tin::orientation(qx, qy, ax, ay, bx, by) > 0.0);
  }
}

}  // namespace
}  // namespace pcl_als
