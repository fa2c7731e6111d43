// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/survey/area_index.h>
#include <pcl_als/survey/survey_map.h>

namespace pcl_als {
namespace {

/// Gently rolling ground with a gable of 30 degrees on it.
double height(double x, double y) {
  const double ground = 100.0 + 0.05 * x + std::sin(y / 40.0);
  const double roof = 6.0 - 0.577 * std::abs(x - 25.0);
  return std::abs(x - 25.0) < 8.0 && std::abs(y - 25.0) < 12.0 ? ground + roof : ground;
}

std::vector<LidarReturn> sampled(unsigned seed, double from, double to,
                                 const Eigen::Vector3d& shift) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> plan(from, to);
  std::vector<LidarReturn> points;
  for (int i = 0; i < static_cast<int>((to - from) * (to - from) * 4.0); ++i) {
    LidarReturn p;
    const double x = plan(random), y = plan(random);
    p.position = Eigen::Vector3d(x, y, height(x, y)) + shift;
    p.time = 10.0;
    points.push_back(p);
  }
  return points;
}

TEST(SurveyMap, FindsOverlapsAndTheirArea) {
  SurveyMap map(Eigen::Vector2d(0.0, 0.0));
  const int a = map.addStrip(), b = map.addStrip(), c = map.addStrip();
  const auto first = sampled(12, 0.0, 100.0, {0, 0, 0}),
             second = sampled(13, 0.0, 100.0, {50, 0, 0}),
             third = sampled(14, 0.0, 100.0, {500, 0, 0});
  map.add(a, first.data(), first.size());
  map.add(b, second.data(), second.size());
  map.add(c, third.data(), third.size());
  const auto overlaps = map.overlaps(100.0);
  ASSERT_EQ(overlaps.size(), 1U);
  EXPECT_EQ(overlaps[0].strips, StripPair(a, b));
  EXPECT_NEAR(overlaps[0].area, 5000.0, 1100.0);  // a row of 10 m cells more or less
}

TEST(SurveyMap, ChoosesAreasWithinTheBudgetThatBothStripsSee) {
  SurveyMap map(Eigen::Vector2d(0.0, 0.0));
  map.addStrip();
  map.addStrip();
  const auto first = sampled(15, 0.0, 300.0, {0, 0, 0}),
             second = sampled(16, 0.0, 300.0, {100, 0, 0});
  map.add(0, first.data(), first.size());
  map.add(1, second.data(), second.size());
  AreaSelection selection;
  const auto all = map.selectAreas({{0, 1}}, selection);
  selection.point_budget = 60'000;
  const auto few = map.selectAreas({{0, 1}}, selection);
  EXPECT_EQ(all.size(), 4U * 6U);
  EXPECT_LT(few.size(), all.size());
  EXPECT_GT(few.size(), 0U);
  for (const SurveyArea& area : all) EXPECT_GE(area.minimum.x(), 99.9);
}

TEST(SurveyMap, CountsWhatIsNotFiniteAndRefusesTheAbsurd) {
  SurveyMap map(Eigen::Vector2d(0.0, 0.0));
  map.addStrip();
  LidarReturn p;
  p.position = Eigen::Vector3d(1.0, NAN, 2.0);
  map.add(0, &p, 1);
  EXPECT_EQ(map.invalidCount(0), 1U);
  EXPECT_EQ(map.pointCount(0), 0U);
  p.position = Eigen::Vector3d(1e18, 0.0, 2.0);
  EXPECT_THROW(map.add(0, &p, 1), InputError);
}

TEST(AreaIndex, FindsTheAreasWhoseMarginHoldsAPoint) {
  const std::vector<SurveyArea> areas{{{100.0, 200.0}, 50.0, 8.0}, {{150.0, 200.0}, 50.0, 8.0}};
  const AreaIndex index(areas);
  const auto covering = [&](const Eigen::Vector3d& p) {
    std::vector<int> found;
    for (const int area : index.candidates(p)) {
      if (areas[static_cast<std::size_t>(area)].covers(p)) found.push_back(area);
    }
    return found;
  };
  EXPECT_EQ(covering({120.0, 220.0, 5.0}), std::vector<int>{0});
  EXPECT_EQ(covering({145.0, 220.0, 5.0}), (std::vector<int>{0, 1}));
  EXPECT_TRUE(covering({91.0, 220.0, 5.0}).empty());
  EXPECT_TRUE(covering({-120.0, -220.0, 5.0}).empty());
}

}  // namespace
}  // namespace pcl_als
