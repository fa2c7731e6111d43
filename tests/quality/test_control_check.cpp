// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

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
  EXPECT_NEAR(result.accuracy->rmse_v, 0.01 * std::sqrt(50.0 / 3.0 + 4.0), 1e-12);
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
  EXPECT_NEAR(result.accuracy->survey, 0.02, 1e-12);
  const auto none = assessControl({bad}, points({"A"}, 0.0), kStrips, 0.02);
  EXPECT_EQ(none.points, 0U);
  EXPECT_FALSE(none.quality_level);
  EXPECT_FALSE(none.accuracy) << "no points, no figures";
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

std::vector<std::string> numbered(std::size_t count) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < count; ++i) ids.push_back("P" + std::to_string(100 + i));
  return ids;
}

// -1.51, -1.50, -1.49 m in turn: mean -1.5, standard deviation 0.01 sqrt(18 / 17 * 2 / 3).
TEST(ControlCheck, AnOffsetThatAllPointsHaveIsAFigureAndNoClass) {
  const auto ids = numbered(18);
  std::vector<ControlDifference> all;
  for (std::size_t i = 0; i < ids.size(); ++i)
    all.push_back(difference(ids[i], "1", -1.51 + 0.01 * static_cast<double>(i % 3)));
  const auto result = assessControl(all, points(ids, 0.0), kStrips, 0.02);
  EXPECT_EQ(result.points, 18U);
  EXPECT_EQ(result.far, ids);
  ASSERT_EQ(result.offsets.size(), 1U);
  EXPECT_NEAR(result.offsets[0].offset, -1.5, 1e-12);
  EXPECT_NEAR(result.offsets[0].std, 0.01 * std::sqrt(12.0 / 17.0 / 18.0), 1e-12);
  EXPECT_EQ(result.offsets[0].describe(),
            "the strips lie 1.50 ± 0.01 m below all 18 control points");
  EXPECT_NEAR(result.all.rms, 1.5, 1e-3);
  ASSERT_TRUE(result.accuracy);
  EXPECT_NEAR(result.accuracy->fit, 1.5, 1e-3);
  EXPECT_EQ(result.no_class, "18 of 18 control points lie more than 1 m above or below the strips");
  EXPECT_FALSE(result.quality_level);
  const Warnings warnings = warningsOf(result);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].text.find("antenna height"), std::string::npos);
}

// Half of the control under a second flight that is 2.3 m too high.
TEST(ControlCheck, AnOffsetOfOneStripIsNamedAndTheRestHasNoClass) {
  const auto ids = numbered(12);
  std::vector<ControlDifference> all;
  for (std::size_t i = 0; i < ids.size(); ++i)
    all.push_back(
        difference(ids[i], i < 6 ? "1" : "2", (i < 6 ? 0.0 : 2.3) + (i % 2 == 0 ? 0.01 : -0.01)));
  const auto result = assessControl(all, points(ids, 0.0), kStrips, 0.02);
  ASSERT_EQ(result.offsets.size(), 1U);
  EXPECT_EQ(result.offsets[0].describe(),
            "strip 2 lies 2.30 ± 0.01 m above all 6 control points that it covers");
  EXPECT_EQ(result.points, 12U) << "figures of all points";
  EXPECT_FALSE(result.no_class.empty());
  EXPECT_FALSE(result.quality_level);
}

// Six of twelve points are 30 cm higher than the others: the strip lies on the one group and 30 cm
// below the other. A strip whose offset differs does not make control contradict itself.
TEST(ControlCheck, PointsThatContradictEachOtherAreNamedAndHaveNoCommonOffset) {
  std::vector<ControlDifference> differences;
  std::vector<std::string> ids;
  for (int i = 0; i < 12; ++i) {
    ids.push_back(std::string("P") + static_cast<char>('A' + i));
    const double noise = 0.004 * (i % 3 - 1), wrong = i % 2 == 0 ? 0.3 : 0.0;
    differences.push_back(difference(ids.back(), "1", -0.2 - wrong + noise));
    if (i < 5) differences.push_back(difference(ids.back(), "2", -0.2 - wrong + noise));
  }
  const auto result = assessControl(differences, points(ids, 0.01), kStrips, 0.02);
  ASSERT_TRUE(result.contradiction);
  EXPECT_EQ(result.contradiction->strip, "1");
  EXPECT_NEAR(result.contradiction->separation, 0.3, 0.005);
  EXPECT_EQ(result.contradiction->lower.size(), 6U);
  EXPECT_TRUE(result.offsets.empty()) << "there is no offset that the points have in common";
  const Warnings warnings = warningsOf(result);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].text.rfind("the control points contradict each other: strip 1 lies 0.3", 0),
            0U)
      << warnings[0].text;

  std::vector<ControlDifference> offset;
  for (int i = 0; i < 12; ++i)
    offset.push_back(difference(ids[static_cast<std::size_t>(i)], i < 6 ? "1" : "2",
                                (i < 6 ? 0.0 : -0.3) + 0.004 * (i % 3 - 1)));
  const auto of_strips = assessControl(offset, points(ids, 0.01), kStrips, 0.02);
  EXPECT_FALSE(of_strips.contradiction);
  ASSERT_EQ(of_strips.offsets.size(), 1U);
  EXPECT_EQ(of_strips.offsets[0].strip, "2");
}

TEST(ControlCheck, ABlunderIsCountedShownAndNotUsed) {
  const auto ids = numbered(20);
  std::vector<ControlDifference> all;
  for (std::size_t i = 0; i < ids.size(); ++i)
    all.push_back(difference(ids[i], "1", i == 7 ? 3.21 : (i % 2 == 0 ? 0.02 : -0.02)));
  const auto result = assessControl(all, points(ids, 0.0), kStrips, 0.02);
  EXPECT_EQ(result.points, 19U);
  EXPECT_EQ(result.far, std::vector<std::string>{"P107"});
  EXPECT_TRUE(result.offsets.empty());
  EXPECT_EQ(result.no_class, "");
  EXPECT_EQ(result.quality_level, 0);
  const Warnings warnings = warningsOf(result);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].text.find("P107 (+3.21 m)"), std::string::npos) << warnings[0].text;
  // Blunders of every size at half of the points: there is nothing in common, and no class.
  for (std::size_t i = 0; i < ids.size(); i += 2)
    all[i].above = (i % 4 == 0 ? 2.0 : -2.0) * static_cast<double>(i + 1);
  const auto many = assessControl(all, points(ids, 0.0), kStrips, 0.02);
  EXPECT_TRUE(many.offsets.empty());
  EXPECT_FALSE(many.no_class.empty());
  EXPECT_FALSE(many.quality_level);
}

/// A difference on a surface with these gradients whose strip has to be moved by \a movement.
ControlDifference onSlope(const std::string& point, const Eigen::Vector2d& gradient,
                          const Eigen::Vector3d& movement, const Eigen::Vector2d& place) {
  ControlDifference d = difference(point, "1", 0.0);
  d.normal = Eigen::Vector3d(-gradient.x(), -gradient.y(), 1.0).normalized();
  // The strip's surface is the true one moved back: z'(x) = z(x + e, y + n) - u.
  d.above = gradient.dot(movement.head<2>()) - movement.z();
  d.position.head<2>() = place;
  return d;
}

TEST(ControlShift, FollowsFromHeightsOnSlopes) {
  const Eigen::Vector3d movement(0.6, -0.4, 0.05);
  std::vector<ControlDifference> all;
  for (const auto& [x, y] : {std::pair(0.2, 0.0), {-0.2, 0.0}, {0.0, 0.1}, {0.0, -0.1}, {0.0, 0.0}})
    all.push_back(onSlope("P" + std::to_string(all.size()), {x, y}, movement, {100.0 * x, y}));
  EXPECT_NEAR(all[0].above, 0.2 * 0.6 - 0.05, 1e-12);  // by hand
  EXPECT_NEAR(all[2].above, 0.1 * -0.4 - 0.05, 1e-12);
  const HorizontalShift found = shiftOntoControl(all);
  ASSERT_TRUE(found.determined) << found.reason;
  EXPECT_LT((found.shift - movement).norm(), 1e-9);
  EXPECT_TRUE(isSignificantInPlan(found));
}

TEST(ControlShift, IsThatOfTheStrips) {
  using namespace test;
  Flight moved;
  moved.shift = {0.3, -0.2, 0.1};
  moved.noise = 0.005;
  const AreaOffsets area = areaOf(fly(village, moved, kOrigin), {});
  std::vector<ControlDifference> all;
  for (const double cx : {15.0, 45.0}) {
    for (const double cy : {15.0, 45.0}) {
      for (const auto& [dx, dy] : {std::pair(3.0, 2.8), {-3.0, 3.1}, {3.0, -2.9}, {-3.0, -3.2}}) {
        const double x = cx + dx, y = cy + dy;
        const ControlPoint point{"P" + std::to_string(all.size()),
                                 kOrigin + Eigen::Vector3d(x, y, village(x, y)), 0.0};
        const auto found = controlDifferences(area, point, {"1"});
        all.insert(all.end(), found.begin(), found.end());
      }
    }
  }
  ASSERT_EQ(all.size(), 16U);
  const HorizontalShift found = shiftOntoControl(all);
  ASSERT_TRUE(found.determined) << found.reason;
  EXPECT_LT((found.shift + moved.shift).norm(), 0.02) << found.shift.transpose();
}

TEST(ControlShift, StandardDeviationsAreRealisticAndLevelGroundHasNone) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1000.0);
  const auto survey = [&](double slope, double slope_std, const Eigen::Vector3d& movement) {
    std::vector<ControlDifference> all;
    for (int i = 0; i < 37; ++i) {
      const Eigen::Vector2d gradient(slope * normal(random), slope * normal(random));
      auto d =
          onSlope("P" + std::to_string(i), gradient, movement, {uniform(random), uniform(random)});
      d.above += 0.025 * normal(random);
      d.normal += slope_std * Eigen::Vector3d(normal(random), normal(random), 0.0);
      d.normal.normalize();
      d.slope_std = slope_std;
      all.push_back(d);
    }
    return shiftOntoControl(all);
  };
  double squares = 0.0;
  int significant = 0, count = 0;
  for (int seed = 0; seed < 100; ++seed) {
    const HorizontalShift found = survey(0.08, 0.008, Eigen::Vector3d::Zero());
    ASSERT_TRUE(found.determined) << found.reason;
    significant += isSignificantInPlan(found) ? 1 : 0;
    for (int i = 0; i < 2; ++i, ++count)
      squares += found.shift[i] * found.shift[i] / (found.std[i] * found.std[i]);
    EXPECT_TRUE(isSignificantInPlan(survey(0.08, 0.008, {0.6, -0.4, 0.0})));
    EXPECT_FALSE(survey(0.01, 0.01, {0.6, -0.4, 0.0}).determined) << "level, but noisy";
  }
  EXPECT_LE(significant, 1);
  EXPECT_GT(std::sqrt(squares / count), 0.6);
  EXPECT_LT(std::sqrt(squares / count), 1.3);
}

}  // namespace
}  // namespace pcl_als
