// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Blocks of a conical scanner, which measures the ground of a strip ahead of the sensor and, some
// seconds later, behind it.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "expected_truth.h"
#include "simulated_survey.h"

namespace pcl_als {
namespace {

using test::SimulatedSurvey;

/// Probability of a time offset in the diagnosis.
double timeOffsetProbability(const CalibrationResult& result) {
  for (const ErrorFinding& finding : result.diagnosis)
    if (finding.source == "time_offset") return finding.probability;
  ADD_FAILURE() << "time_offset is not in the diagnosis";
  return 1.0;
}

/// With triangles that join both looks, lever_arm_y was wrong by three standard deviations, and
/// time offsets of 2 ms were found. Consecutive seeds that no choice preceded; the simulator has no
/// time offset. One block in thirty supports one all the same, so that two of five do in 1 % of
/// such sets; the standard deviation of lever_arm_y then includes it, hence the median over the
/// blocks.
TEST(ConicalScanner, IsCalibratedWithItsLooksApart) {
  std::vector<double> lever_arm_std;
  int supported = 0;
  for (const std::uint64_t seed : {501U, 502U, 503U, 504U, 505U}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    simulation::SimulationOptions options =
        simulation::SimulationOptions::preset("conical", 1.0, 0.3);
    options.noise = simulation::NoiseOptions::named("realistic");
    options.seed = seed;
    const SimulatedSurvey survey(options);
    SimulatedSurvey::Request request;
    request.rigorous = true;
    request.settings.candidates = 30'000;
    const CalibrationResult result = survey.calibrate(request).result;
    EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
    test::expectTruth(result, survey.bias);
    if (timeOffsetProbability(result) > 0.5) ++supported;
    lever_arm_std.push_back(result[SystemParameter::lever_arm_y].std);
    const auto looks = [](const PairFit& pair) { return pair.a == "1" && pair.b == "1"; };
    const auto own = std::find_if(result.pairs.begin(), result.pairs.end(), looks);
    ASSERT_NE(own, result.pairs.end());
    EXPECT_LT(own->rms_after, 0.7 * own->rms_before);
  }
  EXPECT_LE(supported, 1);
  std::nth_element(lever_arm_std.begin(), lever_arm_std.begin() + 2, lever_arm_std.end());
  EXPECT_LT(lever_arm_std[2], 0.02);
}

/// The angle between all pulses and the axis is too large: a scale of angles across the body cannot
/// describe that, and range_bias was 27 standard deviations wrong for a rosette scanner.
TEST(ScannerAboutAnAxis, HasAScaleOfItsDeflection) {
  for (const char* const scanner : {"conical", "rosette"}) {
    simulation::SimulationOptions options =
        simulation::SimulationOptions::preset("small", 1.0, 0.5);
    options.setScanner(scanner);
    options.noise = simulation::NoiseOptions::named("range");
    options.errors.add("deflection_scale=0.0004");
    const SimulatedSurvey survey(options);
    SimulatedSurvey::Request request;
    request.rigorous = true;
    request.control = survey.control;
    request.settings.candidates = 30'000;
    const CalibrationResult result = survey.calibrate(request).result;
    EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
    test::expectTruth(result, survey.bias);
    const auto scale = std::find_if(
        result.diagnosis.begin(), result.diagnosis.end(),
        [](const ErrorFinding& finding) { return finding.source == "deflection_scale"; });
    ASSERT_NE(scale, result.diagnosis.end()) << scanner;
    EXPECT_TRUE(scale->corrected) << scanner;
    EXPECT_NEAR(scale->value, 400.0, 3.5 * scale->std) << scanner;
    EXPECT_LT(scale->std, 60.0) << scanner;
  }
}

/// With all angles in one plane across the body, the scale of the preset mountain (crossing) was
/// 3.6e-5 wrong (19 standard deviations), and the range bias 44 mm (13).
TEST(SeveralScanPlanes, HaveTheScaleOfTheirOwnAngle) {
  for (const char* const scanner : {"cross", "dual"}) {
    simulation::SimulationOptions options =
        simulation::SimulationOptions::preset("small", 1.0, 0.5);
    options.setScanner(scanner);
    options.noise = simulation::NoiseOptions::named("range");
    const SimulatedSurvey survey(options);
    SimulatedSurvey::Request request;
    request.rigorous = true;
    request.control = survey.control;
    request.settings.candidates = 30'000;
    request.settings.diagnose = false;
    const CalibrationResult result = survey.calibrate(request).result;
    EXPECT_EQ(result.scan_planes.size(), 2U);
    test::expectTruth(result, survey.bias);
    // The differences between the models are several times as large.
    EXPECT_LT(result[SystemParameter::scan_angle_scale].std, 8e-6);
    EXPECT_LT(result[SystemParameter::range_bias].std, 5e-3);
  }
}

}  // namespace
}  // namespace pcl_als
