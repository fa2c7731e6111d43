// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/quality/area_offsets.h>

#include "swath_scenes.h"

namespace pcl_als {
namespace {

using test::areaOf;
using test::Flight;
using test::fly;
using test::kOrigin;

double plane(double x, double y) {
  return 0.05 * x - 0.03 * y;  // 3.3 degrees
}

TEST(AreaOffsets, HeightOfAPlaneOverAnother) {
  Flight other;
  other.shift = {0.0, 0.0, -0.25};
  other.seed = 2;
  const AreaOffsets area = areaOf(fly(plane, {}, kOrigin), fly(plane, other, kOrigin));
  const auto samples = area.offsets(0, 1);
  ASSERT_GT(samples.size(), 500U);
  std::size_t beside = 0;
  for (const OffsetSample& s : samples) {
    EXPECT_TRUE(s.level);
    EXPECT_FALSE(s.identical);
    if (!s.conjugate) {  // the nearest triangle's plane is met beside the triangle
      ++beside;
      continue;
    }
    // a over b, whichever strip the point is of; coordinates are rounded to 1 mm, which is all.
    EXPECT_NEAR(s.vertical, 0.25, 0.003);
    EXPECT_NEAR(s.normal_distance, 0.25 / std::sqrt(1.0 + 0.0025 + 0.0009), 0.003);
    EXPECT_NEAR(s.slope, std::atan(std::hypot(0.05, 0.03)), 0.01);
  }
  EXPECT_LT(beside, samples.size() / 50);
  for (const OffsetSample& s : area.offsets(1, 0)) EXPECT_NEAR(s.vertical, -0.25, 0.003);
}

TEST(AreaOffsets, TimesAndAnglesAreThoseOfEachStrip) {
  Flight other;
  other.time = 5000.0;
  other.speed = -50.0;
  other.seed = 2;
  const AreaOffsets area = areaOf(fly(plane, {}, kOrigin), fly(plane, other, kOrigin));
  for (const OffsetSample& s : area.offsets(0, 1)) {
    const Eigen::Vector3d p = s.position - kOrigin;
    // The other strip's are those of the patch's nearest vertex, at most a spacing away.
    EXPECT_NEAR(s.time_a, 1000.0 + p.y() / 60.0, 0.6 / 60.0);
    EXPECT_NEAR(s.time_b, 5000.0 - p.y() / 50.0, 0.6 / 50.0);
    EXPECT_NEAR(s.scan_angle_a, p.x() - 30.0, 0.7);
    EXPECT_NEAR(s.scan_angle_b, 30.0 - p.x(), 0.7);
  }
}

TEST(AreaOffsets, SteepGroundIsNotLevelButHasNormalDistances) {
  const auto steep = [](double x, double) { return 0.2 * x; };  // 11.3 degrees
  Flight other;
  other.shift = {0.10, 0.0, 0.0};  // along the slope: 0.02 m of height
  other.seed = 2;
  const AreaOffsets area = areaOf(fly(steep, {}, kOrigin), fly(steep, other, kOrigin));
  const auto samples = area.offsets(0, 1);
  ASSERT_GT(samples.size(), 300U);
  for (const OffsetSample& s : samples) {
    EXPECT_FALSE(s.level);
    EXPECT_NEAR(s.normal_distance, 0.02 * std::cos(std::atan(0.2)), 0.003);
  }
}

TEST(AreaOffsets, TreesAndEavesAreNoSurface) {
  // A forest: heights jump from point to point, and a house beside it.
  const auto forest = [](double x, double y) {
    if (x > 40.0) return 6.0;  // flat roof, eaves at x = 40
    return 5.0 * std::abs(std::sin(37.0 * x + 91.0 * y));
  };
  Flight other;
  other.seed = 2;
  const AreaOffsets area = areaOf(fly(forest, {}, kOrigin), fly(forest, other, kOrigin));
  for (const OffsetSample& s : area.offsets(0, 1)) {
    EXPECT_GT(s.position.x() - kOrigin.x(), 40.0) << "measured in a tree";
    EXPECT_NEAR(s.vertical, 0.0, 0.002);
  }
}

TEST(AreaOffsets, PlacesAreThoseOfSingleReturns) {
  Flight other;
  other.seed = 2;
  auto a = fly(plane, {}, kOrigin), b = fly(plane, other, kOrigin);
  for (LidarReturn& point : a) point.number_of_returns = 2, point.return_number = 2;
  for (LidarReturn& point : b) point.number_of_returns = 2, point.return_number = 2;
  EXPECT_TRUE(areaOf(a, b).offsets(0, 1).empty());
  for (LidarReturn& point : a) point.number_of_returns = 1, point.return_number = 1;
  EXPECT_FALSE(areaOf(a, b).offsets(0, 1).empty());
}

/// A filter that found the ground in both strips together: within 2 cm of the lowest point of each
/// cell of 1 m it is \a ground, what lies higher is \a above.
void classifyTogether(std::uint8_t ground, std::uint8_t above, std::vector<LidarReturn>& a,
                      std::vector<LidarReturn>& b) {
  const auto cell = [](const LidarReturn& point) {
    return std::make_pair(std::floor(point.position.x()), std::floor(point.position.y()));
  };
  std::map<std::pair<double, double>, double> lowest;
  for (const auto* strip : {&a, &b})
    for (const LidarReturn& point : *strip) {
      double& z = lowest.emplace(cell(point), point.position.z()).first->second;
      z = std::min(z, point.position.z());
    }
  for (auto* strip : {&a, &b})
    for (LidarReturn& point : *strip)
      point.classification = point.position.z() < lowest[cell(point)] + 0.02 ? ground : above;
}

double meanHeight(const std::vector<OffsetSample>& samples) {
  double sum = 0.0, count = 0.0;
  for (const OffsetSample& s : samples)
    if (s.level) sum += s.vertical, count += 1.0;
  return sum / count;
}

// Two strips 4 cm apart with 3 cm of noise. Ground found in both together holds the low points of
// each; of 1600 places per strip the mean of the differences has a standard deviation of 3 cm x
// sqrt(2 / 9) / sqrt(1600) = 0.4 mm, times two for places that share points.
TEST(AreaOffsets, ClassesThatDependOnHeightDoNotMoveTheOffset) {
  Flight first, other;
  first.noise = other.noise = 0.03;
  other.seed = 2;
  other.shift.z() = 0.04;
  SurfaceLimits limits;
  limits.candidates = 1600;
  const auto flat = [](double, double) { return 0.0; };
  auto a = fly(flat, first, kOrigin), b = fly(flat, other, kOrigin);
  const double unclassified = meanHeight(areaOf(a, b, limits).offsets(0, 1));
  EXPECT_NEAR(unclassified, -0.04, 0.003);
  for (const std::uint8_t above : {1, 3, 5}) {
    classifyTogether(2, above, a, b);
    EXPECT_NEAR(meanHeight(areaOf(a, b, limits).offsets(0, 1)), unclassified, 1e-12)
        << "class " << static_cast<int>(above) << " above the ground";
  }
}

// Strips of different noise: the places of either have to show the same offset.
TEST(AreaOffsets, PlacesOfBothStripsShowTheSameOffset) {
  Flight first, other;
  first.noise = 0.05;
  other.noise = 0.01;
  other.seed = 2;
  const auto flat = [](double, double) { return 0.0; };
  const auto a = fly(flat, first, kOrigin), b = fly(flat, other, kOrigin);
  const AreaOffsets area = areaOf(a, b);
  std::set<std::pair<double, double>> of_a;
  for (const LidarReturn& point : a) of_a.emplace(point.position.x(), point.position.y());
  double sums[2] = {0.0, 0.0}, counts[2] = {0.0, 0.0};
  for (const OffsetSample& s : area.offsets(0, 1)) {
    if (!s.level) continue;
    const int side = of_a.count({s.position.x(), s.position.y()}) > 0 ? 0 : 1;
    sums[side] += s.vertical;
    counts[side] += 1.0;
  }
  ASSERT_GT(std::min(counts[0], counts[1]), 100.0);
  // 400 places a strip whose planes share points: 5 cm / 3 / sqrt(400) = 0.8 mm, times two.
  EXPECT_NEAR(sums[0] / counts[0], 0.0, 0.005);
  EXPECT_NEAR(sums[1] / counts[1], 0.0, 0.005);
}

TEST(AreaOffsets, WithheldNoiseAndWaterAreExcluded) {
  AreaOffsets area({kOrigin.head<2>(), 50.0, 5.0}, 1);
  LidarReturn point;
  point.position = kOrigin + Eigen::Vector3d(1.0, 1.0, 0.0);
  area.add(0, point);
  for (const int code : {7, 9, 18}) {
    point.classification = static_cast<std::uint8_t>(code);
    area.add(0, point);
  }
  point.classification = 0;
  point.flags = kWithheld;
  area.add(0, point);
  point.flags = 0;
  point.position.x() = std::nan("");
  area.add(0, point);
  point.position = kOrigin + Eigen::Vector3d(80.0, 1.0, 0.0);  // beside the margin
  area.add(0, point);
  EXPECT_EQ(area.pointCount(), 1U);
}

TEST(AreaOffsets, VegetationIsExcludedWhereItIsHigh) {
  std::vector<LidarReturn> points(5);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].position = kOrigin + Eigen::Vector3d(0.2 * static_cast<double>(i), 0.0, 0.0);
  for (const int i : {1, 2, 3}) points[static_cast<std::size_t>(i)].classification = 5;
  points[1].position.z() += 12.0;
  points[2].position.z() += 1.1;
  points[3].position.z() += 0.9;  // as likely ground as vegetation
  points[4].position.z() += 7.0;  // a roof
  dropHighVegetation(points);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[1].classification, 5);
  EXPECT_NEAR(points[1].position.z() - kOrigin.z(), 0.9, 1e-9);
  EXPECT_EQ(points[2].classification, 0);
}

TEST(AreaOffsets, RepeatedAndCopiedPointsAreSeen) {
  const auto a = fly(plane, {}, kOrigin);
  auto twice = a;
  twice.insert(twice.end(), a.begin(), a.end());
  EXPECT_NEAR(areaOf(twice, a).repeatedShare(0), 0.5, 1e-9);
  EXPECT_EQ(areaOf(a, a).repeatedShare(0), 0.0);
  for (const OffsetSample& s : areaOf(a, a).offsets(0, 1)) EXPECT_TRUE(s.identical);
}

TEST(AreaOffsets, HandfulsOfPointsGiveNothing) {
  const auto a = fly(plane, {}, kOrigin);
  for (const std::size_t count : {0, 1, 2, 3, 5, 11}) {
    const std::vector<LidarReturn> few(a.begin() + 3000, a.begin() + 3000 + count);
    EXPECT_TRUE(areaOf(few, a).offsets(0, 1).empty()) << count;
    EXPECT_TRUE(areaOf(few, few).offsets(0, 1).empty()) << count;
  }
}

TEST(AreaOffsets, HeightAboveAPoint) {
  Flight flight;
  flight.shift.z() = -0.125;
  const auto a = fly(plane, flight, kOrigin);
  AreaOffsets area = areaOf(a, {});
  const Eigen::Vector3d place = kOrigin + Eigen::Vector3d(20.0, 30.0, plane(20.0, 30.0));
  const auto height = area.heightAt(0, place);
  ASSERT_TRUE(height);
  EXPECT_NEAR(height->above, -0.125, 0.002);
  EXPECT_EQ(height->unfit, "");
  EXPECT_FALSE(area.heightAt(1, place)) << "a strip that is not there";
  EXPECT_FALSE(area.heightAt(0, kOrigin + Eigen::Vector3d(100.0, 0.0, 0.0)));
  EXPECT_NEAR(area.heightAt(0, place + Eigen::Vector3d(0.0, 0.0, 5.0))->above, -5.125, 0.002);
  area.release();
  EXPECT_FALSE(area.heightAt(0, place));
}

TEST(AreaOffsets, RoughnessIsThatOfTheNoise) {
  Flight flight;
  flight.noise = 0.02;
  const AreaOffsets area = areaOf(fly(plane, flight, kOrigin), {});
  const std::vector<double> values = area.roughness();
  ASSERT_GT(values.size(), 100U);
  double mean = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  // A plane through about twelve vertices takes three of their degrees of freedom: 0.87 of 2 cm.
  EXPECT_NEAR(mean, 0.0172, 0.002);
}

}  // namespace
}  // namespace pcl_als
