// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/bias_evaluator.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "flights.h"

namespace pcl_als {
namespace {

using test::circling;
using test::sampled;
using test::straight;

struct EffectPoints {
  std::vector<double> time, x, y, z, effect_x, effect_y, effect_z;

  void add(double t, const Eigen::Vector3d& p) {
    time.push_back(t), x.push_back(p.x()), y.push_back(p.y()), z.push_back(p.z());
  }
  PointColumns columns() const { return {time.data(), x.data(), y.data(), z.data()}; }
  EffectColumns effects() {
    effect_x.assign(time.size(), 9.0), effect_y = effect_z = effect_x;
    return {effect_x.data(), effect_y.data(), effect_z.data()};
  }
  Eigen::Vector3d position(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Eigen::Vector3d effect(std::size_t i) const { return {effect_x[i], effect_y[i], effect_z[i]}; }
};

SystemVector allBiases() {
  SystemVector biases;
  biases << 0.1, -0.2, 0.05, 4e-4, -5e-4, 3e-4, 0.12, 4e-4;
  return biases;
}

std::shared_ptr<const Trajectory> circle() {
  return std::make_shared<Trajectory>(sampled(circling, 0.0, 60.0, 0.02));
}

/// A swath under the circle, in order of time.
EffectPoints swath(std::size_t count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> spread(-600.0, 600.0), height(-30.0, 30.0);
  EffectPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    const double time = 60.0 * static_cast<double>(i) / static_cast<double>(count);
    Eigen::Vector3d point = circling(time) + Eigen::Vector3d(spread(random), spread(random), 0.0);
    point.z() = height(random);
    points.add(time, point);
  }
  return points;
}

Eigen::Vector3d reference(const Trajectory& trajectory, double time, const Eigen::Vector3d& point,
                          const SystemVector& biases) {
  SensorPose pose;
  std::size_t cursor = 0;
  EXPECT_TRUE(trajectory.poseAt(time, pose, cursor));
  return point - corrected(pose, point, biases);
}

TEST(BiasEvaluator, EqualsTheDesignBlockToFirstOrder) {
  const auto trajectory = circle();
  EffectPoints points = swath(200);
  const BiasEvaluator evaluator(trajectory, allBiases());
  CoverageCount coverage;
  evaluator.effect(points.columns(), points.time.size(), points.effects(), coverage);
  for (std::size_t k = 0; k < points.time.size(); ++k) {
    SensorPose pose;
    std::size_t cursor = 0;
    ASSERT_TRUE(trajectory->poseAt(points.time[k], pose, cursor));
    const Eigen::Vector3d linear =
        designBlock(scanGeometry(pose, points.position(k))) * allBiases();
    // Products of two angles of up to 7e-4 at up to 1200 m, and of angles with 0.2 m.
    ASSERT_LT((points.effect(k) - linear).norm(), 1.5e-3) << k;
    ASSERT_GT(linear.norm(), 0.3) << k;
  }
}

TEST(BiasEvaluator, EqualsTheScalarFormForEveryParameterAlone) {
  const auto trajectory = circle();
  EffectPoints points = swath(1000);
  for (int i = 0; i < kSystemParameterCount; ++i) {
    const SystemVector biases = allBiases().cwiseProduct(SystemVector::Unit(i));
    const BiasEvaluator evaluator(trajectory, biases);
    CoverageCount coverage;
    evaluator.effect(points.columns(), points.time.size(), points.effects(), coverage);
    EXPECT_EQ(coverage.missed(), 0U);
    for (std::size_t k = 0; k < points.time.size(); ++k) {
      const Eigen::Vector3d expected =
          reference(*trajectory, points.time[k], points.position(k), biases);
      // 1e-10 rad of beta times z dS = 1000 m * 4e-4, and rounding.
      ASSERT_LT((points.effect(k) - expected).norm(), 1e-10) << i << ' ' << k;
    }
  }
}

TEST(BiasEvaluator, EqualsTheScalarFormInSeveralPlanes) {
  const auto trajectory = std::make_shared<const Trajectory>(
      circle()->withScanPlanes({{0.24, 0.970773, 0.0}, {-0.24, 0.970773, 0.0}}));
  EffectPoints points = swath(1000);
  const BiasEvaluator evaluator(trajectory, allBiases()), in_one_plane(circle(), allBiases());
  CoverageCount coverage;
  in_one_plane.effect(points.columns(), points.time.size(), points.effects(), coverage);
  const std::vector<double> other = points.effect_x;
  evaluator.effect(points.columns(), points.time.size(), points.effects(), coverage);
  double largest = 0.0;
  for (std::size_t k = 0; k < points.time.size(); ++k) {
    const Eigen::Vector3d expected =
        reference(*trajectory, points.time[k], points.position(k), allBiases());
    ASSERT_LT((points.effect(k) - expected).norm(), 1e-9) << k;
    largest = std::max(largest, std::abs(points.effect_x[k] - other[k]));
  }
  EXPECT_GT(largest, 0.01);
}

TEST(BiasEvaluator, ScanAngleIsRightAllAroundTheSensor) {
  const auto trajectory = std::make_shared<Trajectory>(sampled(straight(0), 0.0, 10.0, 1.0));
  const SystemVector biases = allBiases().cwiseProduct(SystemVector::Unit(7));
  EffectPoints points;
  for (int degree = -180; degree < 180; ++degree) {
    const double angle = degree * kRadiansPerDegree;
    points.add(5.0, {1000.0 * std::sin(angle), 300.0, 1000.0 - 1000.0 * std::cos(angle)});
  }
  CoverageCount coverage;
  BiasEvaluator(trajectory, biases)
      .effect(points.columns(), points.time.size(), points.effects(), coverage);
  for (std::size_t k = 1; k < points.time.size(); ++k) {  // at -180 both signs are right
    const Eigen::Vector3d expected = reference(*trajectory, 5.0, points.position(k), biases);
    // The stated 1e-10 rad times 1000 m * 4e-4, and rounding near 180 degrees.
    EXPECT_LT((points.effect(k) - expected).norm(), 1e-10) << k;
  }
}

TEST(BiasEvaluator, OrderOfPointsDoesNotChangeABit) {
  const BiasEvaluator evaluator(circle(), allBiases());
  EffectPoints sorted = swath(5000);
  std::vector<std::size_t> order(sorted.time.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  EffectPoints shuffled;
  for (const std::size_t i : order) shuffled.add(sorted.time[i], sorted.position(i));
  CoverageCount coverage;
  evaluator.effect(sorted.columns(), order.size(), sorted.effects(), coverage);
  evaluator.effect(shuffled.columns(), order.size(), shuffled.effects(), coverage);
  for (std::size_t k = 0; k < order.size(); ++k) {
    ASSERT_EQ(shuffled.effect(k), sorted.effect(order[k])) << k;
  }
}

TEST(BiasEvaluator, InverseLeadsBackToTheBiasedPoint) {
  const BiasEvaluator evaluator(circle(), 10.0 * allBiases());
  EffectPoints biased = swath(3000);
  CoverageCount coverage;
  evaluator.effect(biased.columns(), biased.time.size(), biased.effects(), coverage);
  EffectPoints corrected;
  double largest = 0.0;
  for (std::size_t k = 0; k < biased.time.size(); ++k) {
    corrected.add(biased.time[k], biased.position(k) - biased.effect(k));
    largest = std::max(largest, biased.effect(k).norm());
  }
  ASSERT_GT(largest, 5.0);
  evaluator.inverseEffect(corrected.columns(), corrected.time.size(), corrected.effects(),
                          coverage);
  double first_order = 0.0;
  for (std::size_t k = 0; k < biased.time.size(); ++k) {
    // The iteration stops at changes of 1e-7 m and contracts at least tenfold.
    ASSERT_LT((corrected.effect(k) - biased.effect(k)).norm(), 1e-7) << k;
    const Eigen::Vector3d once = reference(evaluator.trajectory(), corrected.time[k],
                                           corrected.position(k), evaluator.biases());
    first_order = std::max(first_order, (once - biased.effect(k)).norm());
  }
  EXPECT_GT(first_order, 1e-3);  // one evaluation would not do
}

TEST(BiasEvaluator, AnInverseThatDoesNotExistIsCounted) {
  // 1 m below the sensor and 99 m of range bias: the point would have to lie behind the sensor.
  const auto trajectory = std::make_shared<Trajectory>(sampled(straight(0), 0.0, 10.0, 1.0));
  EffectPoints points;
  points.add(5.0, {0.1, 300.0, 999.0});
  CoverageCount coverage;
  BiasEvaluator(trajectory, SystemVector::Unit(6) * -99.0)
      .inverseEffect(points.columns(), 1, points.effects(), coverage);
  EXPECT_EQ(coverage.unsolved, 1U);
  EXPECT_NE(coverage.describe(*trajectory).find("no biased position"), std::string::npos);
}

TEST(BiasEvaluator, PointsWithoutTrajectoryAreCountedAndHaveNoEffect) {
  auto samples = sampled(straight(0), 0.0, 10.0, 0.1);
  const auto later = sampled(straight(0), 20.0, 30.0, 0.1);
  samples.insert(samples.end(), later.begin(), later.end());
  const auto trajectory = std::make_shared<Trajectory>(samples);
  EffectPoints points;
  for (const double time : {-5.0, 5.0, 15.0, 15.5, std::nan(""), 25.0, 31.0}) {
    points.add(time, {100.0, 0.0, 0.0});
  }
  CoverageCount coverage;
  BiasEvaluator(trajectory, allBiases())
      .effect(points.columns(), points.time.size(), points.effects(), coverage);
  EXPECT_EQ(coverage.before_start, 1U);
  EXPECT_EQ(coverage.in_gap, 2U);
  EXPECT_EQ(coverage.without_time, 1U);
  EXPECT_EQ(coverage.after_end, 1U);
  EXPECT_EQ(coverage.first_missed, -5.0);
  EXPECT_EQ(coverage.last_missed, 31.0);
  for (const std::size_t k : {0U, 2U, 3U, 4U, 6U}) EXPECT_EQ(points.effect(k).norm(), 0.0) << k;
  for (const std::size_t k : {1U, 5U}) EXPECT_GT(points.effect(k).norm(), 0.0) << k;
  const std::string text = coverage.describe(*trajectory);
  EXPECT_NE(text.find("5 of 7 points have no trajectory"), std::string::npos) << text;
  EXPECT_NE(text.find("-5.000 to 31.000"), std::string::npos) << text;
}

TEST(BiasEvaluator, NanCoordinatesDoNotDisturbTheirNeighbours) {
  const BiasEvaluator evaluator(circle(), allBiases());
  EffectPoints clean = swath(700), holed = clean;
  holed.x[3] = holed.y[3] = holed.z[3] = std::nan("");
  CoverageCount coverage;
  evaluator.inverseEffect(clean.columns(), 700, clean.effects(), coverage);
  evaluator.inverseEffect(holed.columns(), 700, holed.effects(), coverage);
  EXPECT_EQ(coverage.unsolved, 0U);
  for (std::size_t k = 0; k < 700; ++k) {
    if (k == 3) continue;
    ASSERT_EQ(clean.effect(k), holed.effect(k)) << k;
  }
}

TEST(BiasEvaluator, ZeroBiasesGiveZero) {
  EffectPoints points = swath(100);
  CoverageCount coverage;
  BiasEvaluator(circle(), SystemVector::Zero())
      .effect(points.columns(), points.time.size(), points.effects(), coverage);
  for (std::size_t k = 0; k < 100; ++k) EXPECT_EQ(points.effect(k).cwiseAbs().maxCoeff(), 0.0);
}

TEST(BiasEvaluator, RefusesBiasesThatCannotBe) {
  for (int i = 0; i < kSystemParameterCount; ++i) {
    const bool length = systemParameters()[static_cast<std::size_t>(i)].unit == "m";
    EXPECT_THROW(BiasEvaluator(circle(), SystemVector::Unit(i) * (length ? 100.0 : 0.1)),
                 UsageError);
    EXPECT_THROW(BiasEvaluator(circle(), SystemVector::Unit(i) * std::nan("")), UsageError);
  }
  EXPECT_THROW(BiasEvaluator(nullptr, SystemVector::Zero()), UsageError);
}

}  // namespace
}  // namespace pcl_als
