// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include "pair_coverage.h"
#include "warning_texts.h"

namespace pcl_als {
namespace {

constexpr double kLimit = 1.0;  // metres

PairFit fit(const char* a, const char* b, std::size_t correspondences, double rms) {
  PairFit found;
  found.a = a;
  found.b = b;
  found.correspondences = correspondences;
  found.rms_before = rms;
  return found;
}

TEST(PairCoverage, ACompleteBlockIsLeftAsItIs) {
  CalibrationResult result;
  result.pairs = {fit("1", "2", 500, 0.05), fit("2", "3", 400, 0.9)};
  result.verdict.reason = "the misfit is smaller";
  // Height offsets within the limit: what was compared counts, however large its distances are.
  judgePairCoverage({{"1", "2", {0.1, 90}}, {"2", "3", {0.8, 90}}}, kLimit, result);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(result.verdict.reason, "the misfit is smaller");
}

// Two flights of two strips, 2.3 m apart; trees gave the pair 2:3 correspondences.
TEST(PairCoverage, TwoFlightsAtDifferentHeightsAreNotUsable) {
  CalibrationResult result;
  result.pairs = {fit("1", "2", 500, 0.05), fit("4", "3", 400, 0.05), fit("2", "3", 30, 0.5)};
  judgePairCoverage({{"1", "2", {0.0, 90}},
                     {"1", "3", {-2.3, 40}},
                     {"2", "3", {-2.3, 80}},
                     {"3", "4", {0.0, 90}}},
                    kLimit, result);
  EXPECT_EQ(result.verdict.status, CalibrationStatus::parameters_affected);
  EXPECT_EQ(result.verdict.reason,
            "2 of 4 overlapping pairs lie too far apart in height to be compared: strip 1 lies "
            "2.30 m below strip 3 (median of 40 cells of 10 m), strip 2 lies 2.30 m below strip 3 "
            "(median of 80 cells of 10 m)");
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0].hint, Hint::strips);
}

// The lowest points of forest differ although the strips agree elsewhere.
TEST(PairCoverage, StripsThatAgreeOverOthersAreOneBlock) {
  CalibrationResult result;
  result.pairs = {fit("1", "2", 500, 0.05), fit("2", "3", 400, 0.05)};
  judgePairCoverage({{"1", "2", {0.0, 90}}, {"1", "3", {1.4, 25}}, {"2", "3", {0.0, 90}}}, kLimit,
                    result);
  EXPECT_TRUE(result.verdict.usable());
  EXPECT_NE(test::joinedTexts(result.warnings).find("1 of 3 overlapping pairs lies too far"),
            std::string::npos);
  // With correspondences of one surface the lowest points are not believed.
  result.pairs.push_back(fit("3", "1", 300, 0.05));
  result.warnings.clear();
  judgePairCoverage({{"1", "3", {1.4, 25}}}, kLimit, result);
  EXPECT_EQ(test::joinedTexts(result.warnings), "");
}

TEST(PairCoverage, PairsWithoutASurfaceAreCountedAndLoneStripsNamed) {
  CalibrationResult result;
  result.pairs = {fit("1", "2", 500, 0.05), fit("1", "3", 0, 0.0)};
  result.verdict.reason = "the misfit is smaller";
  judgePairCoverage({{"1", "2", {0.0, 90}}, {"1", "3", {0.2, 90}}, {"2", "3", {0.2, 90}}}, kLimit,
                    result);
  EXPECT_TRUE(result.verdict.usable());
  EXPECT_EQ(result.verdict.reason,
            "the misfit is smaller; 2 of 3 overlapping pairs were not compared, because no smooth "
            "surface in common was found: strips 1 and 3, 2 and 3");
  EXPECT_EQ(test::joinedTexts(result.warnings),
            "strip 3 has no pairs with any strip although it overlaps others: no smooth surface "
            "in common was found\n");
}

}  // namespace
}  // namespace pcl_als
