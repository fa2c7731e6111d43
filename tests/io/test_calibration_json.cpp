// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/io/survey_io.h>

#include "test_files.h"

namespace pcl_als {
namespace {

using P = SystemParameter;

CalibrationResult example() {
  CalibrationResult result;
  result[P::boresight_roll] = {90.0 * kRadiansPerArcsec, 0.5 * kRadiansPerArcsec,
                               0.1 * kRadiansPerArcsec, ParameterStatus::estimated, ""};
  result[P::range_bias] = {-0.12, 0.003, 0.0001, ParameterStatus::estimated, ""};
  result[P::lever_arm_z] = {0.0, 0.0, 0.0, ParameterStatus::not_estimable, "dZ cancels"};
  result.correlation_order = {P::boresight_roll, P::range_bias};
  result.correlation = (Eigen::MatrixXd(2, 2) << 1.0, -0.25, -0.25, 1.0).finished();
  result.sigma0 = 1.0 / 3.0;
  result.redundancy = 123456;
  result.converged = true;
  result.line_fit_half_width = 0.5;
  result.iterations = {{1000, 2.5, 0.75}, {1001, 1.0, 1e-5}};
  result.pairs = {{"1", "2", 500, 0.5, 0.02, -0.1, 1e-4}};
  result.control = {{"1", 37, 0.1, 0.2, 0.3, 0.4}};
  result.pairs[0].rms_strips = 0.015;
  result.residuals = {{-0.5, 0.0, 0.5}, {3, 4}, {0, 9}};
  result.strip_errors = {{"7", {{401000.5, {0.01, -0.02, 0.03}, {1e-5, -2e-5, 3e-5}}}, {}},
                         {"8", {}, {}}};
  result.observability = {"weak: lever_arm_y with boresight_pitch"};
  result.warnings = {"quoted \"text\""};
  result.inputs = {"strip1.las", "a\xff.las"};  // the second is no UTF-8
  return result;
}

std::string textOf(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::string exampleText() {
  const auto path = test::scratch("calibration_json") / "calibration.json";
  writeCalibration(path, example());
  return textOf(path);
}

/// The message of reading the example with \a from replaced by \a to.
std::string refusalOfChange(const std::string& from, const std::string& to) {
  std::string text = exampleText();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto path = test::scratch("calibration_json") / "changed.json";
  std::ofstream(path, std::ios::binary) << text;
  const std::string message = test::messageOf<InputError>([&] { readCalibration(path); });
  EXPECT_NE(message.find("changed.json: "), std::string::npos) << message;
  return message;
}

TEST(CalibrationJson, KeepsTheModelAndItsAttitude) {
  const auto path = test::scratch("calibration_json") / "attitude.json";
  for (const auto attitude :
       {AttitudeSource::none, AttitudeSource::points, AttitudeSource::trajectory}) {
    CalibrationResult written = example();
    written.attitude = attitude;
    writeCalibration(path, written);
    EXPECT_EQ(readCalibration(path).attitude, attitude);
    const std::string model =
        attitude == AttitudeSource::trajectory ? "rigorous" : "quasi_rigorous";
    EXPECT_NE(textOf(path).find("\"model\": \"" + model + '"'), std::string::npos);
  }
  EXPECT_NE(refusalOfChange("\"quasi_rigorous\"", "\"vague\"").find("'vague'"), std::string::npos);
  EXPECT_NE(refusalOfChange("\"quasi_rigorous\"", "\"rigorous\"").find("attitude"),
            std::string::npos);
}

TEST(CalibrationJson, ReadsBackWhatItWrote) {
  const auto path = test::scratch("calibration_json") / "calibration.json";
  const CalibrationResult written = example();
  writeCalibration(path, written);
  const CalibrationResult read = readCalibration(path);
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate &a = written[info.parameter], &b = read[info.parameter];
    // The angles go through arc-seconds: one rounding each way.
    EXPECT_DOUBLE_EQ(a.bias, b.bias) << info.name;
    EXPECT_DOUBLE_EQ(a.std, b.std);
    EXPECT_DOUBLE_EQ(a.std_formal, b.std_formal);
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.reason, b.reason);
  }
  EXPECT_EQ(read.attitude, written.attitude);
  EXPECT_EQ(read.correlation_order, written.correlation_order);
  EXPECT_EQ(read.correlation, written.correlation);
  EXPECT_EQ(read.sigma0, written.sigma0);  // to the last bit
  EXPECT_EQ(read.redundancy, written.redundancy);
  EXPECT_TRUE(read.converged);
  EXPECT_EQ(read.line_fit_half_width, 0.5);
  EXPECT_EQ(read.iterations.at(1).largest_update, 1e-5);
  ASSERT_EQ(read.strip_errors.size(), 2U);
  EXPECT_EQ(read.strip_errors[0].id, "7");
  const TrajectoryErrorKnot& knot = read.strip_errors[0].knots.at(0);
  EXPECT_EQ(knot.time, 401000.5);
  EXPECT_EQ(knot.position, Eigen::Vector3d(0.01, -0.02, 0.03));
  EXPECT_TRUE(knot.angles.isApprox(Eigen::Vector3d(1e-5, -2e-5, 3e-5)));
  EXPECT_EQ(read.observability, written.observability);
  ASSERT_EQ(read.pairs.size(), 1U);
  EXPECT_EQ(read.pairs[0].rms_strips, 0.015);
  EXPECT_EQ(read.pairs[0].b, "2");
  EXPECT_EQ(read.pairs[0].rms_after, 0.02);
  EXPECT_EQ(read.residuals.edges, (std::vector<double>{-0.5, 0.0, 0.5}));
  EXPECT_EQ(read.residuals.before, (std::vector<std::size_t>{3, 4}));
  EXPECT_EQ(read.residuals.after, (std::vector<std::size_t>{0, 9}));
  EXPECT_EQ(read.control.at(0).rms_after, 0.4);
  EXPECT_EQ(textsOf(read.warnings), textsOf(written.warnings));
  EXPECT_EQ(read.inputs[0], written.inputs[0]);
}

CalibrationResult writtenAndRead(const CalibrationResult& result) {
  return parseCalibration(calibrationJson(result), "written.json");
}

TEST(CalibrationJson, KeepsTheScanPlanes) {
  CalibrationResult result = example();
  EXPECT_EQ(writtenAndRead(result).scan_planes, ScanPlanes());
  result.scan_planes = {{0.6, 0.8, 0.0}, {-0.6, 0.8, 0.0}};
  EXPECT_EQ(writtenAndRead(result).scan_planes, result.scan_planes);
  result.scan_planes[0] *= 1.1;
  EXPECT_THROW(writtenAndRead(result), InputError);
}

TEST(CalibrationJson, KeepsErrorSourcesThatNoDiagnosisStates) {
  CalibrationResult result = example();
  result.sources[indexOf(ErrorSource::time_offset)] = 1e-3;
  result.crs = "EPSG:25832";
  const CalibrationResult read = writtenAndRead(result);
  EXPECT_DOUBLE_EQ(read.sources[indexOf(ErrorSource::time_offset)], 1e-3);
  EXPECT_EQ(read.crs, "EPSG:25832");
}

TEST(CalibrationJson, KeepsTheRecoveredAttitudeToTheLastDigit) {
  CalibrationResult result = example();
  result.recovered_attitude.addPass({{401003.0496681234, {1.0 / 300.0, -2.0 / 700.0}}});
  const CalibrationResult read = writtenAndRead(result);
  const RecoveredAttitude::Knot& knot = read.recovered_attitude.passes().at(0).at(0);
  EXPECT_EQ(knot.time, 401003.0496681234);
  EXPECT_DOUBLE_EQ(knot.angles.pitch, 1.0 / 300.0);
  EXPECT_DOUBLE_EQ(knot.angles.crab, -2.0 / 700.0);
}

TEST(CalibrationJson, KeepsTheSystems) {
  CalibrationResult written = example();
  written.channel_field = "user_data";
  written.systems.resize(2);
  for (SystemEstimate& system : written.systems) system.parameters = written.parameters;
  written.systems[0].group = {"a", {"3.ch0", "4.ch0"}};
  SystemEstimate& second = written.systems[1];
  second.group = {"b", {"3.ch1"}};
  second.parameters[indexOf(P::range_bias)].bias = 0.25;
  second.difference_std[indexOf(P::range_bias)] = 0.002;
  second.offset = {0.1, -0.2, 0.3};
  second.offset_std = {0.01, 0.02, 0.03};
  const auto path = test::scratch("calibration_json") / "systems.json";
  writeCalibration(path, written);
  const CalibrationResult read = readCalibration(path);
  EXPECT_EQ(read.channel_field, "user_data");
  ASSERT_EQ(read.systems.size(), 2U);
  EXPECT_EQ(read.systems[0].group.strips, written.systems[0].group.strips);
  EXPECT_EQ(read.systems[1].group.name, "b");
  EXPECT_LT((read.systems[1].values() - second.values()).norm(), 1e-15);
  EXPECT_LT((read.systems[1].difference_std - second.difference_std).norm(), 1e-15);
  EXPECT_EQ(read.systems[1].offset_std, second.offset_std);
  writeCalibration(path, example());
  EXPECT_TRUE(readCalibration(path).systems.empty());
  writeCalibration(path, written);
  std::string text = textOf(path);
  text.replace(text.find("-0.2"), 4, "-200");
  std::ofstream(path, std::ios::binary) << text;
  EXPECT_THROW(readCalibration(path), InputError);
}

TEST(CalibrationJson, KeepsCovariancesOfStrips) {
  CalibrationResult written = example();
  StripErrors& strip = written.strip_errors[0];
  strip.knots[0].position_std = {0.0123456, 0.01, 0.02};
  strip.knots[0].angles_std = {1e-5, 2e-5, 3e-5};
  StripErrorCorrelation& correlation = strip.correlations.emplace_back();
  correlation.time = 401000.5;
  correlation.errors.setIdentity();
  correlation.errors(4, 0) = correlation.errors(0, 4) = -0.98765;
  correlation.parameters.setConstant(6, static_cast<int>(written.correlation_order.size()), 0.25);
  written.error_levels = ErrorLevels{0.01, 1e-5, 2e-5, 0.003, 0.02, 3e-5, 6e-5};
  const auto path = test::scratch("calibration_json") / "covariances.json";
  writeCalibration(path, written);
  const CalibrationResult read = readCalibration(path);
  const TrajectoryErrorKnot& knot = read.strip_errors[0].knots[0];
  EXPECT_EQ(knot.position_std.x(), 0.0123456);
  EXPECT_DOUBLE_EQ(knot.angles_std.z(), 3e-5);
  ASSERT_EQ(read.strip_errors[0].correlations.size(), 1U);
  const StripErrorCorrelation& back = read.strip_errors[0].correlations[0];
  EXPECT_EQ(back.time, 401000.5);
  EXPECT_EQ(back.errors(0, 4), -0.98765);
  EXPECT_EQ(back.errors(4, 0), -0.98765);
  EXPECT_EQ(back.parameters, correlation.parameters);
  ASSERT_TRUE(read.error_levels.has_value());
  EXPECT_DOUBLE_EQ(read.error_levels->range, 0.01);
  EXPECT_NEAR(read.error_levels->trajectory_heading, 6e-5, 1e-15);
  EXPECT_NE(textOf(path).find("\"up_std_m\": 0.02"), std::string::npos);
}

TEST(CalibrationJson, RefusesCovariancesThatAreNone) {
  CalibrationResult written = example();
  StripErrors& strip = written.strip_errors[0];
  strip.knots[0].position_std = strip.knots[0].angles_std = {0.01, 0.01, 0.01};
  const auto path = test::scratch("calibration_json") / "covariances.json";
  writeCalibration(path, written);
  std::string text = textOf(path);
  const std::size_t at = text.find("\"up_std_m\": 0.01");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 16, "\"up_std_m\": -0.1");
  std::ofstream(path, std::ios::binary) << text;
  EXPECT_THROW(readCalibration(path), InputError);
}

TEST(CalibrationJson, UsesTheInterfacesNamesAndUnits) {
  const std::string text = exampleText();
  for (const char* part :
       {"\"format\": \"pcl_als calibration\"", "\"version\": 2", "\"model\": \"quasi_rigorous\"",
        "\"unit\": \"arcsec\"", "\"status\": \"not_estimable\"", "\"std_formal\": ",
        "\"line_fit_half_width_s\": 0.5", "\"redundancy\": 123456", "\"converged\": true",
        "\"rms_before_m\": 0.5", "\"mean_after_m\": ", "\"tool_version\": \""}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
  }
  const std::size_t roll = text.find("\"boresight_roll\"");
  const std::size_t bias = text.find("\"bias\": ", roll);
  EXPECT_NEAR(std::stod(text.substr(bias + 8)), 90.0, 1e-12);
}

TEST(CalibrationJson, KeepsTheVerdictAndTheMisfit) {
  const auto path = test::scratch("calibration_json") / "verdict.json";
  CalibrationResult written = example();
  written.verdict.downgrade(CalibrationStatus::no_improvement, "the misfit is larger");
  written.misfit = {5310, 42, 0.031, 0.033, 0.2, 0.0005};
  writeCalibration(path, written);
  EXPECT_NE(textOf(path).find("\"status\": \"no_improvement\""), std::string::npos);
  const CalibrationResult read = readCalibration(path);
  EXPECT_EQ(read.verdict.status, CalibrationStatus::no_improvement);
  EXPECT_EQ(read.verdict.reason, "the misfit is larger");
  EXPECT_EQ(read.misfit.points, 5310U);
  EXPECT_EQ(read.misfit.areas, 42U);
  EXPECT_EQ(read.misfit.rms_before, 0.031);
  EXPECT_EQ(read.misfit.rms_after, 0.033);
  EXPECT_EQ(read.misfit.limit, 0.2);
  EXPECT_EQ(read.misfit.change_std, 0.0005);
  EXPECT_NE(refusalOfChange("\"status\": \"usable\"", "\"status\": \"splendid\"").find("splendid"),
            std::string::npos);
}

TEST(CalibrationJson, KeepsTheControlPoints) {
  const auto path = test::scratch("calibration_json") / "control.json";
  CalibrationResult written = example();
  written.control_points = {{"a", "normal", 2, 0.01, 0.3, 0.02, 0.015, true},
                            {"b", "height", 1, 0.0, 0.5, 0.21, 0.025, false}};
  writeCalibration(path, written);
  const CalibrationResult read = readCalibration(path);
  ASSERT_EQ(read.control_points.size(), 2U);
  EXPECT_EQ(read.control_points[0].id, "a");
  EXPECT_EQ(read.control_points[0].component, "normal");
  EXPECT_EQ(read.control_points[0].strips, 2U);
  EXPECT_EQ(read.control_points[0].sigma, 0.01);
  EXPECT_TRUE(read.control_points[0].used);
  EXPECT_EQ(read.control_points[1].before, 0.5);
  EXPECT_EQ(read.control_points[1].after, 0.21);
  EXPECT_EQ(read.control_points[1].expected_std, 0.025);
  EXPECT_FALSE(read.control_points[1].used);
}

TEST(CalibrationJson, KeepsWhatWasHeldFixed) {
  const auto path = test::scratch("calibration_json") / "held.json";
  CalibrationResult written = example();
  written.held = {
      {"fixed strips", {"1", "4"}, 0.02, 0.0, 70, 0.1, 0.2, 0.01, 0.03, -0.04, 0.05, true},
      {"dem.tif", {}, 0.03, 0.5}};
  writeCalibration(path, written);
  const CalibrationResult read = readCalibration(path);
  ASSERT_EQ(read.held.size(), 2U);
  EXPECT_EQ(read.held[0].strips, (std::vector<std::string>{"1", "4"}));
  EXPECT_EQ(read.held[0].correspondences, 70U);
  EXPECT_EQ(read.held[0].rms_after, 0.03);
  EXPECT_EQ(read.held[0].offset, -0.04);
  EXPECT_TRUE(read.held[0].offset_determined);
  EXPECT_EQ(read.held[1].name, "dem.tif");
  EXPECT_EQ(read.held[1].offset_prior, 0.5);
}

TEST(CalibrationJson, FilesWithoutAVerdictHaveOneByTheirConvergence) {
  std::string text = exampleText();
  const std::size_t from = text.find("\"verdict\""), to = text.find("\"model\"");
  text.erase(from, to - from);
  const auto path = test::scratch("calibration_json") / "old.json";
  std::ofstream(path) << text;
  EXPECT_TRUE(readCalibration(path).verdict.usable());
  text.replace(text.find("\"converged\": true"), 17, "\"converged\": false");
  std::ofstream(path) << text;
  EXPECT_EQ(readCalibration(path).verdict.status, CalibrationStatus::not_converged);
}

TEST(CalibrationJson, UnknownStandardDeviationsAreNull) {
  CalibrationResult result = example();
  result[P::lever_arm_z].std = std::nan("");
  const auto path = test::scratch("calibration_json") / "calibration.json";
  writeCalibration(path, result);
  EXPECT_NE(textOf(path).find("\"std\": null"), std::string::npos);
  EXPECT_TRUE(std::isnan(readCalibration(path)[P::lever_arm_z].std));
}

TEST(CalibrationJson, ABiasThatIsNotFiniteIsNotWritten) {
  CalibrationResult result = example();
  result[P::range_bias].bias = std::nan("");
  const auto path = test::scratch("calibration_json") / "calibration.json";
  EXPECT_THROW(writeCalibration(path, result), UsageError);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(CalibrationJson, ParametersAloneAreEnough) {
  std::string text = exampleText();
  const std::size_t end = text.find("\"correlation\"");
  text = text.substr(0, end) + "\"line_fit_half_width_s\": 1}}";
  const auto path = test::scratch("calibration_json") / "short.json";
  std::ofstream(path) << text;
  EXPECT_DOUBLE_EQ(readCalibration(path).biases()[6], -0.12);
}

TEST(CalibrationJson, ErrorsNameTheKey) {
  const struct {
    const char *from, *to, *expected;
  } cases[] = {
      {"pcl_als calibration", "other", "not a calibration file"},
      {"\"format\"", "\"forma\"", "not a calibration file"},
      {"\"version\": 2", "\"version\": 3", "'version' is 3"},
      {"\"version\": 2", "\"version\": 0", "'version' is 0"},
      {"\"version\": 2", "\"version\": \"2\"", "'version' must be a whole number"},
      {"\"instrument\"", "\"instrumen\"", "'instrument.parameters' is missing"},
      {"\"range_bias\"", "\"range\"", "'instrument.parameters.range_bias' is missing"},
      {"\"unit\": \"arcsec\"", "\"unit\": \"deg\"",
       "'instrument.parameters.boresight_pitch.unit' is 'deg'"},
      {"\"bias\": -0.12", "\"bias\": null",
       "'instrument.parameters.range_bias.bias' must be a number"},
      {"\"bias\": -0.12", "\"bias\": \"-0.12\"",
       "'instrument.parameters.range_bias.bias' must be a number"},
      {"\"bias\": -0.12", "\"bias\": 1e999", "is not valid JSON"},
      {"\"bias\": -0.12", "\"bias\": NaN", "is not valid JSON"},
      {"\"bias\": -0.12", "\"bia\": 1", "'instrument.parameters.range_bias.bias' is missing"},
      {"\"bias\": -0.12", "\"bias\": -120",
       "'instrument.parameters.range_bias.bias' is out of range: -120 m is not between -100 and "
       "100 m"},
      {"\"up_m\": 0.03", "\"up_m\": 1e6",
       "'flight.strip_corrections[0].knots[0].up_m' is out of range: 1e+06 m is not between -100 "
       "and 100"},
      {"\"east_m\": 0.01", "\"east_m\": 0.01, \"east_m\": 0.02", "'east_m' stands twice"},
      {"\"version\": 2", "\"version\": 2, \"version\": 2", "'version' stands twice"},
      {"\"line_fit_half_width_s\": 0.5", "\"line_fit_half_width_s\": 1e9", "exceed 60 seconds"},
      {"\"status\": \"fixed\"", "\"status\": \"free\"",
       "must be estimated, fixed or not_estimable"},
      {"\"line_fit_half_width_s\": 0.5", "\"line_fit_half_width_s\": -1", "must not be negative"},
      {"\"converged\": true", "\"converged\": 1", "'report.converged' must be true or false"},
      {"\"pairs\": [", "\"pairs\": [3, ", "'report.pairs[0]' must be an object"},
      {"\"order\": [", "\"order\": [\"dx\", ", "names no system parameter: 'dx'"},
      {"{", "", "is not valid JSON"},
  };
  for (const auto& row : cases) {
    const std::string message = refusalOfChange(row.from, row.to);
    EXPECT_NE(message.find(row.expected), std::string::npos) << row.expected << " / " << message;
  }
}

TEST(CalibrationJson, AFolderThatDoesNotExistIsNamed) {
  const auto path = test::scratch("calibration_json") / "none" / "calibration.json";
  try {
    writeCalibration(path, example());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("none"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pcl_als
