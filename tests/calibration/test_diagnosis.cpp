// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Simulated blocks with errors beyond the system parameters. The simulator defines them by its own
// forward chain (simulation/error_sources.h); definitions are converted by hand here.
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "simulated_survey.h"

namespace pcl_als {
namespace {

CalibrationResult diagnosed(const std::string& errors, unsigned seed) {
  auto options = simulation::SimulationOptions::preset("small");
  options.noise = simulation::NoiseOptions::named("realistic");
  options.seed = seed;
  if (!errors.empty()) options.errors.add(errors);
  const test::SimulatedSurvey survey(options);
  test::SimulatedSurvey::Request request;
  request.control = survey.control;
  request.rigorous = true;
  return survey.calibrate(request).result;
}

std::map<std::string, ErrorFinding> findingsOf(const CalibrationResult& result) {
  std::map<std::string, ErrorFinding> findings;
  for (const ErrorFinding& finding : result.diagnosis) findings[finding.source] = finding;
  return findings;
}

int supportedIn(const std::map<std::string, ErrorFinding>& findings) {
  int count = 0;
  for (const ErrorSourceInfo& info : errorSources()) {
    const auto finding = findings.find(std::string(info.name));  // of this kind of scanner
    if (finding == findings.end()) continue;
    count += finding->second.determined && finding->second.probability > 0.5 ? 1 : 0;
  }
  return count;
}

TEST(Diagnosis, FindsNothingInABlockWithoutFurtherErrors) {
  const CalibrationResult result = diagnosed("", 2);
  EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
  const auto findings = findingsOf(result);
  EXPECT_EQ(supportedIn(findings), 0);
  EXPECT_TRUE(result.sources.isZero(0.0));
  EXPECT_GT(findings.at("boresight_roll").probability, 0.99);  // -90"
  EXPECT_EQ(findings.count("lever_arm_z"), 0U);                // never estimated
}

/// Torsion and a cubic error of the encoder together: both are found and removed, and the system
/// parameters stay within four standard deviations (a chance of 1e-4 each).
TEST(Diagnosis, FindsTwoErrorsAtOnce) {
  const CalibrationResult result = diagnosed("mirror_torsion=15,encoder_cubic=0.006", 3);
  const auto findings = findingsOf(result);
  EXPECT_EQ(supportedIn(findings), 2);
  const ErrorFinding& torsion = findings.at("mirror_torsion");
  EXPECT_GT(torsion.probability, 0.99);
  EXPECT_TRUE(torsion.corrected);
  // The simulator's torsion is positive for a scan to the right.
  EXPECT_NEAR(torsion.value, -15.0, 4.0 * torsion.std);
  const ErrorFinding& cubic = findings.at("encoder_cubic");
  // b^3 = angle^3 (2/5 P3 + 3/5 P1)
  const double edge = 0.4 * 0.006 * std::pow(result.source_scale.largest_angle, 3);
  EXPECT_NEAR(cubic.value, edge / kRadiansPerArcsec,
              4.0 * cubic.std + 0.02 * std::abs(cubic.value));
  EXPECT_NEAR(cubic.effect, edge * 1250.0, 0.1 * edge * 1250.0);  // range at the edge of the swath
  EXPECT_NEAR(result[SystemParameter::boresight_roll].bias / kRadiansPerArcsec, -90.0,
              4.0 * result[SystemParameter::boresight_roll].std / kRadiansPerArcsec);
  EXPECT_LT(result.misfit.rms_after, 0.04);
}

/// A scale that is larger than expected increases the variance components of the strips' heights,
/// until it is corrected: it is no less determined for that, and the range bias is right.
TEST(Diagnosis, CorrectsALargeScaleOfTheRanges) {
  const CalibrationResult result = diagnosed("range_scale=0.0003", 3);
  EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
  const auto findings = findingsOf(result);
  EXPECT_EQ(supportedIn(findings), 1);
  const ErrorFinding& scale = findings.at("range_scale");
  EXPECT_TRUE(scale.corrected);
  EXPECT_NEAR(scale.value, 300.0, 3.0 * scale.std);
  EXPECT_LT(scale.std, 30.0);
  const ParameterEstimate& range = result[SystemParameter::range_bias];
  EXPECT_NEAR(range.bias, 0.12, 4.0 * range.std);
  EXPECT_LT(range.std, 0.05);
}

/// Evidence for a time offset that does not suffice to correct it: lever_arm_y takes in its effect,
/// which its standard deviation includes.
TEST(Diagnosis, UndecidedSourcesIncreaseStandardDeviations) {
  const CalibrationResult result = diagnosed("time_offset=3", 19);
  const ErrorFinding offset = findingsOf(result).at("time_offset");
  ASSERT_GT(offset.probability, 0.25);
  ASSERT_FALSE(offset.corrected);
  const ParameterEstimate& lever = result[SystemParameter::lever_arm_y];
  EXPECT_GT(std::abs(lever.bias + 0.05), 0.1);
  EXPECT_NEAR(lever.bias, -0.05, 3.0 * lever.std);
  EXPECT_LT(lever.std, 0.25);
}

/// Without attitude in the trajectory, a time offset and a lever arm forward have the same effect.
TEST(Diagnosis, NamesWhatTheBlockCannotDetermine) {
  auto options = simulation::SimulationOptions::preset("small");
  options.noise = simulation::NoiseOptions::named("realistic");
  options.vertical = true;
  options.errors.add("time_offset=3");
  const test::SimulatedSurvey survey(options);
  test::SimulatedSurvey::Request request;
  request.control = survey.control;
  request.settings.recover_attitude = false;
  const auto findings = findingsOf(survey.calibrate(request).result);
  const ErrorFinding& offset = findings.at("time_offset");
  EXPECT_FALSE(offset.determined);
  EXPECT_FALSE(offset.corrected);
  EXPECT_NE(offset.evidence.find("cannot"), std::string::npos) << offset.evidence;
}

/// Findings of a block with fewer points, flown on two days.
std::map<std::string, ErrorFinding> findingsOfTwoDays(const std::string& errors,
                                                      bool diagnose = true) {
  auto options = simulation::SimulationOptions::preset("small", 1.0, 0.4);
  options.noise = simulation::NoiseOptions::named("realistic");
  options.seed = 2;
  options.setSessions(2);
  if (!errors.empty()) options.errors.add(errors);
  const test::SimulatedSurvey survey(options);
  test::SimulatedSurvey::Request request;
  request.control = survey.control;
  request.rigorous = true;
  request.settings.diagnose = diagnose;
  request.settings.candidates = 10'000;
  request.settings.selection.point_budget = 200'000;
  return findingsOf(survey.calibrate(request).result);
}

/// Strip 3 is wrong by a jump in its middle, the second day by its heights: each is found with its
/// size, and neither is where it was not put.
TEST(Diagnosis, FindsJumpsAndDifferencesBetweenSessions) {
  const auto jump = findingsOfTwoDays("strip3:jump_z=0.12"),
             offset = findingsOfTwoDays("session2:offset_z=0.12");
  const ErrorFinding& jumped = jump.at("trajectory_jump");
  EXPECT_GT(jumped.probability, 0.9);
  EXPECT_NEAR(jumped.value, 0.12, 3.0 * jumped.std);
  EXPECT_NE(jumped.evidence.find("in strip 3, up"), std::string::npos) << jumped.evidence;
  EXPECT_LT(offset.at("trajectory_jump").probability, 0.5);
  const ErrorFinding& up = offset.at("session2_offset_up");
  EXPECT_GT(up.probability, 0.9);
  EXPECT_NEAR(up.value, 0.12, 3.0 * up.std);
  EXPECT_FALSE(up.corrected);
  EXPECT_NE(up.title.find("session 2 against session 1"), std::string::npos) << up.title;
  for (const auto* findings : {&jump, &offset}) {
    for (const auto& [source, finding] : *findings) {
      if (source.find("session2") != 0 || &finding == &up) continue;
      EXPECT_LT(finding.probability, 0.5) << source;
    }
  }
}

TEST(Diagnosis, CanBeLeftOut) {
  EXPECT_TRUE(findingsOfTwoDays("strip3:jump_z=0.12", false).empty());
}

/// A range error that depends on the intensity makes range_bias that of one intensity, which is
/// stated. The simulator's error is zero at its reference intensity.
TEST(Diagnosis, StatesTheIntensityOfTheRangeBias) {
  const CalibrationResult result = diagnosed("range_walk=0.03", 3);
  const double walk = result.sources[indexOf(ErrorSource::intensity_ranging)];
  ASSERT_NE(walk, 0.0);
  const ParameterEstimate& range = result[SystemParameter::range_bias];
  char intensity[32];
  std::snprintf(intensity, sizeof intensity, "%.4g", result.source_scale.median_intensity);
  EXPECT_NE(range.reason.find("at an intensity of " + std::string(intensity)), std::string::npos)
      << range.reason;
}

}  // namespace
}  // namespace pcl_als
