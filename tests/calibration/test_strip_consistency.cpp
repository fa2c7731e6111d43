// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "strip_consistency.h"

namespace pcl_als {
namespace {

constexpr StripErrorPrior kPrior{0.02, 20.0};

/// Strips of 60 s, five minutes apart, at 1000 m, each overlapping the next two.
struct StripChain {
  std::vector<StripFacts> strips;
  std::vector<double> heights;  ///< metres, of each strip above its true place

  explicit StripChain(std::vector<double> of_strips) : heights(std::move(of_strips)) {
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const double start = 300.0 * static_cast<double>(i);
      strips.push_back({std::to_string(i + 1), start, start + 60.0, 1000.0});
    }
  }
  StripConsistency consistency() const {
    std::vector<PairFit> pairs;
    for (std::size_t a = 0; a < strips.size(); ++a) {
      for (std::size_t b = a + 1; b < std::min(a + 3, strips.size()); ++b) {
        PairFit pair;
        pair.a = strips[a].id, pair.b = strips[b].id;
        pair.correspondences = 5000;
        pair.mean_after = heights[a] - heights[b];
        pairs.push_back(pair);
      }
    }
    return {strips, pairs, kPrior};
  }
};

TEST(StripConsistency, TheMeanOfAProcessVariesLessThanTheProcess) {
  EXPECT_NEAR(kPrior.meanStd(0.1), 0.02, 1e-4);
  // 2 / 5 (1 - (1 - e^-5) / 5) of the variance over five correlation times.
  EXPECT_NEAR(kPrior.meanStd(100.0), 0.02 * std::sqrt(0.4 * (1.0 - (1.0 - std::exp(-5.0)) / 5.0)),
              1e-12);
}

TEST(StripConsistency, FindsTheOffsetsOfTheStrips) {
  const StripConsistency found = StripChain({0.01, -0.02, 0.0, 0.03, -0.02}).consistency();
  ASSERT_EQ(found.offsets().size(), 5U);
  EXPECT_NEAR(found.offsets()[3].offset, 0.03, 1e-6);
  EXPECT_NEAR(found.offsets()[1].offset, -0.02, 1e-6);
}

TEST(StripConsistency, StripsWithinTheirPriorAreNotRemarked) {
  // 5 % of the blocks may get a warning; 200 blocks of eight strips.
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, kPrior.meanStd(60.0));
  int alarms = 0;
  for (int k = 0; k < 200; ++k) {
    std::vector<double> heights(8);
    for (double& height : heights) height = noise(random);
    alarms += StripChain(heights).consistency().warnings().empty() ? 0 : 1;
  }
  EXPECT_LE(alarms, 16);  // 10 + 2 sqrt(10)
}

TEST(StripConsistency, AStripThatDoesNotFitIsNamed) {
  const StripChain block({0.003, -0.004, 0.002, 0.063, -0.001, 0.004});
  const StripConsistency found = block.consistency();
  ASSERT_EQ(found.warnings().size(), 1U);
  EXPECT_NE(found.warnings()[0].text.find("strip 4 lies 0.06"), std::string::npos)
      << found.warnings()[0].text;
  EXPECT_FALSE(found.offsets()[3].consistent);
  EXPECT_TRUE(found.offsets()[2].consistent);
}

TEST(StripConsistency, ALowStripLiesBelowTheOthers) {
  const StripConsistency found =
      StripChain({0.003, -0.004, -0.063, 0.002, -0.001, 0.004}).consistency();
  ASSERT_EQ(found.warnings().size(), 1U);
  EXPECT_NE(found.warnings()[0].text.find("strip 3 lies 0.06"), std::string::npos);
  EXPECT_NE(found.warnings()[0].text.find(" m below the others"), std::string::npos);
}

TEST(StripConsistency, ASessionOfAnotherDayIsNamedWithItsHeight) {
  StripChain block({0.003, -0.004, 0.002, 0.051, 0.048, 0.052});
  for (std::size_t i = 3; i < 6; ++i)
    block.strips[i].start += 86400.0, block.strips[i].end += 86400.0;
  StripConsistency found = block.consistency();
  ASSERT_FALSE(found.warnings().empty());
  EXPECT_NE(
      found.warnings()[0].text.find("strips 4, 5, 6 were measured 24.1 hours after the others"),
      std::string::npos)
      << found.warnings()[0].text;
  EXPECT_NE(found.warnings()[0].text.find("0.050 m above them"), std::string::npos)
      << found.warnings()[0].text;
  // Without a difference in height the session is still named.
  for (std::size_t i = 3; i < 6; ++i) block.heights[i] -= 0.05;
  found = block.consistency();
  ASSERT_EQ(found.warnings().size(), 1U);
  EXPECT_NE(found.warnings()[0].text.find("another session"), std::string::npos);
}

TEST(StripConsistency, StripsOfAnotherFlyingHeightThatDoNotFitAreNamed) {
  StripChain block({0.003, -0.004, 0.002, 0.058, 0.062, 0.064});
  for (std::size_t i = 3; i < 6; ++i) block.strips[i].height = 1600.0;
  const StripConsistency found = block.consistency();
  ASSERT_FALSE(found.warnings().empty());
  EXPECT_NE(found.warnings()[0].text.find("strips 4, 5, 6, flown at 1600 m"), std::string::npos)
      << found.warnings()[0].text;
}

TEST(StripConsistency, TwoStripsCannotBeJudged) {
  EXPECT_TRUE(StripChain({0.1, -0.1}).consistency().warnings().empty());
}

}  // namespace
}  // namespace pcl_als
