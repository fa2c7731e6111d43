// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/quality/control_check.h>

#include "swath_scenes.h"

namespace pcl_als {
namespace {

const std::vector<std::string> kStrips{"1", "2", "3"};

ControlDifference difference(const std::string& point, const std::string& strip, double above) {
  ControlDifference d;
  d.point = point;
  d.strip = strip;
  d.above = above;
  return d;
}

std::vector<ControlPoint> points(const std::vector<std::string>& ids, double sigma) {
  std::vector<ControlPoint> control;
  for (const std::string& id : ids) control.push_back({id, Eigen::Vector3d::Zero(), sigma});
  return control;
}

// Strip 1: 3 and 5 cm (mean 4, RMSE sqrt(17)); strip 2: -4 cm; all: RMSE sqrt((9 + 25 + 16) / 3).
TEST(ControlCheck, FiguresByHand) {
  const auto result = assessControl(
      {difference("A", "1", 0.03), difference("A", "2", -0.04), difference("B", "1", 0.05)},
      points({"A", "B", "C"}, 0.02), kStrips, 0.5);
  ASSERT_EQ(result.strips.size(), 2U);
  EXPECT_EQ(result.strips[0].offsets.count, 2U);
  EXPECT_NEAR(result.strips[0].offsets.mean, 0.04, 1e-12);
  EXPECT_NEAR(result.strips[0].offsets.rms, 0.01 * std::sqrt(17.0), 1e-12);
  EXPECT_NEAR(result.strips[0].offsets.std, 0.01 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(result.strips[1].offsets.mean, -0.04, 1e-12);
  EXPECT_NEAR(result.all.rms, 0.01 * std::sqrt(50.0 / 3.0), 1e-12);
  EXPECT_EQ(result.points, 2U);
  EXPECT_EQ(result.unseen, std::vector<std::string>{"C"});
  EXPECT_TRUE(result.survey_known);
  EXPECT_NEAR(result.accuracy.rmse_v, 0.01 * std::sqrt(50.0 / 3.0 + 4.0), 1e-12);
  EXPECT_EQ(result.quality_level, 0);  // 4.08 cm, at most 5
}

TEST(ControlCheck, UnfitPlacesDoNotCount) {
  auto bad = difference("A", "1", 3.0);
  bad.unfit = "on a wall";
  const auto result =
      assessControl({bad, difference("B", "1", 0.01)}, points({"A", "B"}, 0.0), kStrips, 0.02);
  EXPECT_EQ(result.differences.size(), 2U);
  EXPECT_EQ(result.all.count, 1U);
  EXPECT_EQ(result.points, 1U);
  EXPECT_TRUE(result.unseen.empty()) << "seen, but not fit";
  EXPECT_FALSE(result.survey_known);
  EXPECT_NEAR(result.accuracy.survey, 0.02, 1e-12);
  const auto none = assessControl({bad}, points({"A"}, 0.0), kStrips, 0.02);
  EXPECT_EQ(none.points, 0U);
  EXPECT_FALSE(none.quality_level);
}

TEST(ControlCheck, StripsOverAPointOfTheSurface) {
  using namespace test;
  Flight low;
  low.shift.z() = -0.05;
  low.seed = 2;
  const AreaOffsets area = areaOf(fly(village, {}, kOrigin), fly(village, low, kOrigin));
  const ControlPoint point{"P", kOrigin + Eigen::Vector3d(30.0, 30.0, village(30.0, 30.0)), 0.0};
  const auto found = controlDifferences(area, point, {"1", "2"});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].above, 0.0, 0.003);  // the curve between points: 0.5^2 / 8 * 0.3 / 81 m
  EXPECT_NEAR(found[1].above, -0.05, 0.003);
  EXPECT_EQ(found[1].strip, "2");
  EXPECT_TRUE(found[0].unfit.empty());
}

}  // namespace
}  // namespace pcl_als
