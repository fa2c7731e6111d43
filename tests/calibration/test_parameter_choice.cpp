// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/parameter_text.h>

#include "parameter_choice.h"
#include "simulated_observations.h"

namespace pcl_als {
namespace {

TEST(ParameterChoice, DropsWhatTheObservationsDoNotSee) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  auto areas = simulated(someBiases(), 0.0, 5);
  for (AreaObservations& area : areas) {
    for (PairObservation& o : area)
      o.row_a[indexOf(P::lever_arm_x)] = o.row_b[indexOf(P::lever_arm_x)] = 0.0F;
  }
  const auto weights = unitWeights(areas);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, weights);
  const ParameterChoice choice =
      chooseParameters(adjustment, kSix, SystemVector::Zero(), DeterminationLimits(), 1.0);
  EXPECT_EQ(choice.status[indexOf(P::lever_arm_x)], ParameterStatus::not_estimable);
  EXPECT_EQ(choice.reason[indexOf(P::lever_arm_x)], "the observations do not depend on it");
  EXPECT_EQ(choice.estimate.size(), 5U);
  EXPECT_EQ(choice.status[indexOf(P::range_bias)], ParameterStatus::fixed);  // was not wanted
}

TEST(ParameterChoice, OfTwoThatLookAlikeTheLeverArmGoes) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  auto areas = simulated(someBiases(), 0.02, 6);
  for (AreaObservations& area : areas) {
    for (PairObservation& o :
         area) {  // a single flying height: pitch moves points as a lever arm does
      o.row_a[indexOf(P::lever_arm_y)] = o.row_a[indexOf(P::boresight_pitch)] / 1000.0F;
      o.row_b[indexOf(P::lever_arm_y)] = o.row_b[indexOf(P::boresight_pitch)] / 1000.0F;
    }
  }
  const auto weights = unitWeights(areas);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, weights);
  const ParameterChoice choice =
      chooseParameters(adjustment, kSix, SystemVector::Zero(), DeterminationLimits(), 1.0);
  EXPECT_EQ(choice.status[indexOf(P::lever_arm_y)], ParameterStatus::not_estimable);
  EXPECT_NE(choice.reason[indexOf(P::lever_arm_y)].find("boresight_pitch"), std::string::npos);
  EXPECT_EQ(choice.status[indexOf(P::boresight_pitch)], ParameterStatus::estimated);
}

/// 2026-11-21: with every parameter dropped the solution had no shared errors, and residuals read
/// past their end.
TEST(ParameterChoice, WithNothingLeftResidualsAreTheMisclosures) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  auto areas = simulated(someBiases(), 0.02, 7);
  for (AreaObservations& area : areas) {
    for (PairObservation& o : area) o.row_a.setZero(), o.row_b.setZero();
  }
  const auto weights = unitWeights(areas);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, weights);
  const ParameterChoice choice =
      chooseParameters(adjustment, kSix, SystemVector::Zero(), DeterminationLimits(), 1.0);
  EXPECT_TRUE(choice.estimate.empty());
  ASSERT_EQ(choice.solution.shared.size(), errors.unknowns());
  EXPECT_EQ(adjustment.residual(areas[0][0], choice.solution), areas[0][0].misclosure);
}

TEST(ParameterChoice, WritesValuesInTheirUnit) {
  EXPECT_EQ(inUnit(P::lever_arm_x, 0.1234), "0.123 m");
  EXPECT_EQ(inUnit(P::boresight_roll, 10.0 * kRadiansPerArcsec), "10 arcsec");
  EXPECT_EQ(inUnit(P::scan_angle_scale, 3e-4), "0.0003");
}

TEST(ParameterChoice, LimitsOfAnglesFollowTheFlyingHeight) {
  // 8 cm, the limit of a lever arm, is 60 arcsec at 275 m and 226 arcsec at 73 m.
  const DeterminationLimits given;
  EXPECT_EQ(given.atHeight(300.0).roll_pitch, given.roll_pitch);
  EXPECT_EQ(given.atHeight(0.0).roll_pitch, given.roll_pitch);  // unknown
  const DeterminationLimits low = given.atHeight(73.0);
  EXPECT_NEAR(low.roll_pitch, 0.08 / 73.0, 1e-9);
  EXPECT_NEAR(low.heading / given.heading, low.roll_pitch / given.roll_pitch, 1e-9);
  EXPECT_NEAR(low.scan_angle_scale / given.scan_angle_scale, low.roll_pitch / given.roll_pitch,
              1e-9);
  EXPECT_EQ(low.lever_arm, given.lever_arm);
  EXPECT_EQ(low.range, given.range);
}

}  // namespace
}  // namespace pcl_als