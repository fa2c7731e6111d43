// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include "simulated_observations.h"
#include "strip_error_check.h"

namespace pcl_als {
namespace {

/// Two strips; the second has a constant error in height and in roll.
CalibrationResult resultWithStripError(double up, double roll) {
  CalibrationResult result;
  result.strip_errors = {{"7", {{0.0}, {1.0}}, {}}, {"8", {{0.0}, {1.0}}, {}}};
  for (TrajectoryErrorKnot& knot : result.strip_errors[1].knots) {
    knot.position.z() = up;
    knot.angles[1] = roll;
  }
  return result;
}

/// lever_arm_x depends on the prior, boresight_roll does not.
std::vector<PriorEffect> effects() {
  return {{SystemParameter::boresight_roll, 1e-7, 1e-6, 1.1e-6},
          {SystemParameter::lever_arm_x, -0.2, 0.02, 0.3}};
}

/// With \a effects, where any correction is large.
void assess(CalibrationResult& result) {
  const CalibrationSettings settings;
  const bool large =
      !largeStripErrors(result.strip_errors, settings.shared_errors, kNoticeableCorrection).empty();
  assessStripErrors(settings, large ? effects() : std::vector<PriorEffect>(), HeightError(),
                    result);
}

TEST(StripErrorCheck, AcceptsErrorsOfTheAPrioriSize) {
  CalibrationResult result =
      resultWithStripError(0.04, -16.0 * kRadiansPerArcsec);  // two deviations each
  assess(result);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_TRUE(result.verdict.usable());
}

TEST(StripErrorCheck, WarnsBeyondThreeDeviations) {
  CalibrationResult result = resultWithStripError(0.0, -32.0 * kRadiansPerArcsec);
  assess(result);
  ASSERT_EQ(result.warnings.size(), 2U);  // the correction, and the parameters
  EXPECT_NE(result.warnings[0].text.find("strip 8: trajectory correction in roll of 32 arcsec"),
            std::string::npos)
      << result.warnings[0].text;
  EXPECT_NE(result.warnings[0].text.find("4.0 times"), std::string::npos)
      << result.warnings[0].text;
  EXPECT_TRUE(result.verdict.usable());
}

TEST(StripErrorCheck, ObjectsBeyondFive) {
  CalibrationResult result = resultWithStripError(-0.307, 0.0);
  assess(result);
  EXPECT_EQ(result.verdict.status, CalibrationStatus::parameters_affected);
  EXPECT_NE(result.verdict.reason.find("height of 307 mm"), std::string::npos)
      << result.verdict.reason;
  EXPECT_NE(result.verdict.reason.find("20 mm"), std::string::npos);
  // The parameters that change are named with the change; the others are not.
  EXPECT_NE(result.verdict.reason.find("lever_arm_x (-0.2 m, 10.0 standard deviations"),
            std::string::npos)
      << result.verdict.reason;
  EXPECT_EQ(result.verdict.reason.find("boresight_roll"), std::string::npos);
  EXPECT_NE(result[SystemParameter::lever_arm_x].reason, "");
  EXPECT_EQ(result[SystemParameter::boresight_roll].reason, "");
}

TEST(StripErrorCheck, NoObjectionWhereNoParameterDependsOnThem) {
  CalibrationResult result = resultWithStripError(-0.307, 0.0);
  assessStripErrors(CalibrationSettings(), {effects().front()}, HeightError(), result);
  EXPECT_TRUE(result.verdict.usable());
  EXPECT_EQ(result.warnings.size(), 1U);
}

/// A known cause is named in place of errors of the trajectory's positions and attitude.
TEST(StripErrorCheck, NamesAKnownCauseFirst) {
  ErrorFinding finding;
  finding.source = "channel1_boresight_roll";
  finding.probability = 1.0;
  finding.determined = true;
  HeightError height;
  height.kind = HeightError::Kind::gross;
  for (const bool by_height : {false, true}) {
    CalibrationResult result = resultWithStripError(-0.307, 0.0);
    result.diagnosis = {finding};
    assessStripErrors(CalibrationSettings(), effects(), by_height ? height : HeightError(), result);
    const std::string text =
        "1 trajectory correction beyond three a priori standard deviations (largest: strip 8, "
        "height, 307 mm), of which " +
        std::string(by_height ? "the height of the trajectory" : "channel1_boresight_roll") +
        " may be the cause";
    EXPECT_NE(result.warnings[0].text.find(text), std::string::npos) << result.warnings[0].text;
    EXPECT_NE(result.verdict.reason.find(text), std::string::npos) << result.verdict.reason;
    EXPECT_EQ(result.verdict.reason.find("check the"), std::string::npos);
  }
  // The parameters themselves and what is not supported are no cause.
  for (const char* source : {"boresight_roll", "session2_offset_up", "trajectory_jump"}) {
    CalibrationResult result = resultWithStripError(-0.307, 0.0);
    finding.source = source;
    result.diagnosis = {finding};
    assessStripErrors(CalibrationSettings(), effects(), HeightError(), result);
    EXPECT_NE(result.verdict.reason.find("check the unit"), std::string::npos) << source;
  }
}

// Had errors of the size found been expected, the solution is the one that expects them.
TEST(StripErrorCheck, EffectsAreThoseOfAnEnlargedPrior) {
  std::vector<AreaObservations> areas = simulated(someBiases(), 0.01, 3);
  for (AreaObservations& area : areas) {
    for (PairObservation& o : area) {
      o.misclosure += (o.a == 1 ? 0.3 : -0.3) * o.normal.x();  // strip 1 lies east
    }
  }
  const std::vector<TimeSpan> spans{{0.0, 25.0}, {100.0, 125.0}};
  const auto weights = unitWeights(areas);
  SharedErrors errors(spans, model());
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, weights);
  ParameterChoice choice;
  choice.estimate = kSix;
  choice.solution = adjustment.solve(kSix, SystemVector::Zero());
  const std::vector<StripErrorSize> large{{"1", 0, 0.3, model().position}};
  const auto found = priorEffects(large, {"0", "1"}, adjustment, choice);
  ASSERT_EQ(found.size(), kSix.size());
  // Afterwards all is as before.
  EXPECT_TRUE(adjustment.solve(kSix, SystemVector::Zero()).biases.isApprox(choice.solution.biases));
  errors.setVarianceFactor(1, 0, std::pow(0.3 / model().position, 2));
  Adjustment enlarged(errors);
  enlarged.accumulate(areas, weights);
  const AdjustmentSolution other = enlarged.solve(kSix, SystemVector::Zero());
  for (const PriorEffect& effect : found) {
    const int i = indexOf(effect.parameter);
    EXPECT_NEAR(effect.change, other.biases[i] - choice.solution.biases[i],
                1e-9 + 1e-6 * effect.std);
    EXPECT_NEAR(effect.std_enlarged, std::sqrt(other.covariance(i, i)), 1e-6 * effect.std_enlarged);
  }
}

TEST(StripErrorCheck, ReportsThatOnlyCorrectionsMakeStripsAgree) {
  PairFit fit;
  fit.correspondences = 100;
  fit.rms_before = fit.rms_after = 0.2;
  fit.rms_strips = 0.03;
  CalibrationResult small = resultWithStripError(0.0, 0.0);  // as after an earlier calibration
  small.pairs = {fit};
  assess(small);
  EXPECT_EQ(small.warnings.size(), 1U);
  EXPECT_TRUE(small.verdict.usable());
  CalibrationResult large = resultWithStripError(0.08, 0.0);  // four a priori standard deviations
  large.pairs = {fit};
  assess(large);
  EXPECT_EQ(large.verdict.status, CalibrationStatus::parameters_affected);
  large = resultWithStripError(0.08, 0.0);
  fit.rms_after = 0.05;  // the biases explain most of the misfit
  large.pairs = {fit};
  assess(large);
  EXPECT_TRUE(large.verdict.usable());
  EXPECT_EQ(large.warnings.size(), 2U);
}

/// A block that was calibrated with a trajectory 50 m too high, or with angles of another factor.
CalibrationResult calibratedFrom1150Metres(HeightError::Kind kind, bool with_arm = true) {
  using P = SystemParameter;
  CalibrationResult result;
  const auto set = [&result](P parameter, double bias, double std) {
    result[parameter].status = ParameterStatus::estimated;
    result[parameter].bias = bias;
    result[parameter].std = std;
  };
  if (with_arm) set(P::lever_arm_x, 0.03, 0.01);
  set(P::boresight_roll, 4e-4, 1e-6);
  set(P::boresight_heading, 2e-4, 1e-5);
  HeightError error;
  error.kind = kind;
  error.metres = 50.0;
  error.slope = 1150.0 / 1100.0;
  assessHeight(error, CalibrationSettings(), result);
  return result;
}

// 2026-11: at one flying height, lever_arm_x was 4.8 standard deviations wrong with a warning only.
TEST(StripErrorCheck, AHeightThatMayBeWrongIsInTheStandardDeviations) {
  using P = SystemParameter;
  const CalibrationResult result = calibratedFrom1150Metres(HeightError::Kind::scale);
  EXPECT_TRUE(result.verdict.usable());
  EXPECT_NEAR(result[P::lever_arm_x].std, std::hypot(0.01, 50.0 * 4e-4), 1e-12);
  EXPECT_EQ(result[P::boresight_roll].std, 1e-6);
  EXPECT_EQ(result[P::boresight_heading].std, 1e-5);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].text.find("standard deviations of lever_arm_x include"),
            std::string::npos)
      << result.warnings[0].text;
  const CalibrationResult fixed = calibratedFrom1150Metres(HeightError::Kind::scale, false);
  EXPECT_NEAR(fixed[P::boresight_roll].std, 4e-4 * 50.0 / 1150.0, 1e-6);
}

TEST(StripErrorCheck, AHeightThatIsWrongIsAnObjection) {
  using P = SystemParameter;
  const CalibrationResult result = calibratedFrom1150Metres(HeightError::Kind::offset);
  EXPECT_EQ(result.verdict.status, CalibrationStatus::parameters_affected);
  EXPECT_EQ(result[P::lever_arm_x].std, 0.01);
  EXPECT_FALSE(result[P::lever_arm_x].reason.empty());
  EXPECT_TRUE(calibratedFrom1150Metres(HeightError::Kind::none).verdict.usable());
}

}  // namespace
}  // namespace pcl_als
