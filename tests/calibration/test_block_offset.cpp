// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Offsets of the coordinates of a whole block from control or from surfaces that are held fixed.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "expected_truth.h"
#include "simulated_survey.h"
#include "warning_texts.h"

namespace pcl_als {
namespace {

using P = SystemParameter;
using simulation::NoiseOptions;
using simulation::SimulationOptions;
using test::expectTruth;
using test::isWarnedOf;
using test::SimulatedSurvey;

/// A block of two flying heights without biases; \a errors as of the simulator.
SimulationOptions unbiasedBlock(const std::string& errors, unsigned seed = 1,
                                const char* preset = "small") {
  SimulationOptions options = SimulationOptions::preset(preset, 0.5, 0.3);
  options.noise = NoiseOptions::named("realistic");
  options.bias.setZero();
  options.seed = seed;
  if (!errors.empty()) options.errors.add(errors);
  return options;
}

CalibrationResult calibratedWithTacticalSystem(const SimulatedSurvey& survey,
                                               const std::vector<std::string>& fixed = {}) {
  SimulatedSurvey::Request request;
  request.rigorous = true;
  request.settings.shared_errors = SharedErrorModel::ofGrade("tactical");
  request.settings.fixed = fixed;
  if (fixed.empty()) request.control = survey.control;
  return survey.calibrate(request).result;
}

ErrorFinding findingOf(const CalibrationResult& result, ErrorSource source) {
  for (const ErrorFinding& finding : result.diagnosis)
    if (finding.source == infoOf(source).name) return finding;
  ADD_FAILURE() << "no finding " << infoOf(source).name;
  return {};
}

/// The height offset is corrected with its size, and the parameters that resemble it are zero.
void expectOffset(const CalibrationResult& result, double truth) {
  const ErrorFinding offset = findingOf(result, ErrorSource::height_offset);
  EXPECT_TRUE(offset.corrected) << offset.probability << ' ' << offset.value << ' ' << offset.std;
  EXPECT_NEAR(result.sources[indexOf(ErrorSource::height_offset)], truth, 3.0 * offset.std);
  EXPECT_LT(offset.std, 0.1);
  expectTruth(result, SystemVector::Zero());
  EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
  EXPECT_TRUE(isWarnedOf(result.warnings, truth < 0.0 ? "m below" : "m above"));
}

/// The heights of control after the calibration.
void expectControlFits(const CalibrationResult& result) {
  int rejected = 0;
  double sum = 0.0;
  for (const ControlPointFit& point : result.control_points) {
    rejected += point.used ? 0 : 1;
    if (point.used) sum += point.after;
  }
  const auto count = static_cast<double>(result.control_points.size());
  EXPECT_LE(rejected, 0.1 * count);
  EXPECT_NEAR(sum / count, 0.0, 0.02);
}

/// range_bias was 0.30 and scan_angle_scale -2.4e-4, both with a probability of 1.
TEST(BlockOffset, IsNoRangeBias) {
  const CalibrationResult result =
      calibratedWithTacticalSystem(SimulatedSurvey(unbiasedBlock("offset_z=-0.3")));
  expectOffset(result, -0.3);
  expectControlFits(result);
}

/// Heights beyond any error of the system and beyond the distance of pairs: all control was
/// rejected or not found.
TEST(BlockOffset, OfMetresIsFound) {
  for (const double truth : {1.5, -6.0}) {
    const CalibrationResult result = calibratedWithTacticalSystem(
        SimulatedSurvey(unbiasedBlock("offset_z=" + std::to_string(truth))));
    expectOffset(result, truth);
    expectControlFits(result);
  }
}

/// The same of surfaces that are held fixed.
TEST(BlockOffset, FromAFixedStrip) {
  SimulatedSurvey survey(unbiasedBlock("offset_z=-0.3"));
  const SimulatedSurvey correct(unbiasedBlock(""));
  survey.strips[2] = correct.strips[2];
  const CalibrationResult result = calibratedWithTacticalSystem(survey, {"3"});
  const ErrorFinding offset = findingOf(result, ErrorSource::height_offset);
  const double of_block =
      result.sources[indexOf(ErrorSource::height_offset)] - result[P::range_bias].bias;
  EXPECT_NEAR(of_block, -0.3, 4.0 * 0.03);  // metres: trajectory errors of the fixed strip
  EXPECT_TRUE(offset.corrected || !result[P::range_bias].determined);
}

/// Control on slopes shows a shift in plan.
TEST(BlockOffset, InPlanShowsOnSlopes) {
  const CalibrationResult result =
      calibratedWithTacticalSystem(SimulatedSurvey(unbiasedBlock("offset_x=0.6,offset_y=-0.4")));
  const ErrorFinding east = findingOf(result, ErrorSource::east_offset);
  const ErrorFinding north = findingOf(result, ErrorSource::north_offset);
  EXPECT_TRUE(east.corrected && north.corrected);
  EXPECT_NEAR(east.value, 0.6, 3.0 * east.std);
  EXPECT_NEAR(north.value, -0.4, 3.0 * north.std);
  EXPECT_FALSE(findingOf(result, ErrorSource::height_offset).corrected);
  expectTruth(result, SystemVector::Zero());
}

/// A block without an offset has none, and a range bias remains one.
TEST(BlockOffset, IsAbsentWhereARangeBiasIs) {
  SimulationOptions options = unbiasedBlock("");
  options.bias[indexOf(P::range_bias)] = 0.5;
  const CalibrationResult result = calibratedWithTacticalSystem(SimulatedSurvey(options));
  EXPECT_EQ(result.sources[indexOf(ErrorSource::height_offset)], 0.0);
  EXPECT_NEAR(result[P::range_bias].bias, 0.5, 4.0 * result[P::range_bias].std);
}

/// Without control nothing shows an offset of the block, and none is reported.
TEST(BlockOffset, IsNoHypothesisWithoutControl) {
  SimulatedSurvey survey(unbiasedBlock("offset_z=-0.3"));
  survey.control.clear();
  const CalibrationResult result = calibratedWithTacticalSystem(survey);
  for (const ErrorFinding& finding : result.diagnosis)
    EXPECT_NE(finding.source, infoOf(ErrorSource::height_offset).name);
}

/// One flying height over flat ground: only the sum of range bias and offset has a value.
TEST(BlockOffset, OnlyTheSumIsDeterminedAtOneHeight) {
  SimulatedSurvey survey(unbiasedBlock("offset_z=-0.3"));
  SimulatedSurvey::Request request;
  request.rigorous = true;
  request.control = survey.control;
  request.settings.shared_errors = SharedErrorModel::ofGrade("tactical");
  survey.strips.resize(2);
  const CalibrationResult result = survey.calibrate(request).result;
  const ParameterEstimate& range = result[P::range_bias];
  const double offset = result.sources[indexOf(ErrorSource::height_offset)];
  EXPECT_NEAR(offset - range.bias, -0.3, 0.05);
  if (offset != 0.0) return;
  EXPECT_FALSE(range.determined);
  EXPECT_NE(range.reason.find("height offset"), std::string::npos) << range.reason;
  EXPECT_FALSE(findingOf(result, ErrorSource::height_offset).determined);
  EXPECT_TRUE(isWarnedOf(result.warnings, "the correction of points is the same"));
}

}  // namespace
}  // namespace pcl_als
