// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/report/mounting_report.h>

namespace pcl_als {
namespace {

CalibrationResult calibration(double pitch, double roll, double correlation) {
  CalibrationResult result;
  result.attitude = AttitudeSource::trajectory;
  ParameterEstimate& of_pitch = result[SystemParameter::boresight_pitch];
  ParameterEstimate& of_roll = result[SystemParameter::boresight_roll];
  of_pitch.bias = pitch * kRadiansPerArcsec, of_roll.bias = roll * kRadiansPerArcsec;
  of_pitch.std = 3.0 * kRadiansPerArcsec, of_roll.std = 4.0 * kRadiansPerArcsec;
  of_pitch.status = of_roll.status = ParameterStatus::estimated;
  result.correlation_order = {SystemParameter::boresight_pitch, SystemParameter::boresight_roll};
  result.correlation = Eigen::Matrix2d::Identity();
  result.correlation(0, 1) = result.correlation(1, 0) = correlation;
  return result;
}

MountingInput arcsecInput(const Eigen::Vector3d& degrees) {
  MountingInput input;
  input.convention = mountingConventionNamed("zyx_frd");
  input.convention.unit = "arcsec";
  input.angles = 3600.0 * degrees;
  return input;
}

bool remarks(const MountingReport& report, const std::string& text) {
  for (const std::string& remark : report.remarks)
    if (remark.find(text) != std::string::npos) return true;
  return false;
}

std::string refusal(const CalibrationResult& of, const MountingInput& input) {
  try {
    reportMounting(of, "calibration.json", input);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

// Turned by a yaw of 45 degrees, the roll of the mounting is (roll + pitch) / sqrt(2) of the body:
// with standard deviations of 4", 3" and the correlation 0.5 its variance is (16 + 9 + 12) / 2.
TEST(MountingReport, CorrelationsOfTheCalibration) {
  const MountingReport straight =
      reportMounting(calibration(0, 0, 0.5), "c.json", arcsecInput({0, 0, 0}));
  EXPECT_NEAR(straight.correction.std(0), 4.0, 1e-9);
  EXPECT_NEAR(straight.correction.std(1), 3.0, 1e-9);
  EXPECT_NEAR(straight.correction.covariance(0, 1), 6.0, 1e-9);
  EXPECT_EQ(straight.correction.std(2), 0.0);
  const MountingReport turned =
      reportMounting(calibration(0, 0, 0.5), "c.json", arcsecInput({0, 0, 45}));
  EXPECT_NEAR(std::pow(turned.correction.std(0), 2), 18.5, 1e-6);
  EXPECT_NEAR(std::pow(turned.correction.std(1), 2), 6.5, 1e-6);
}

// Assumed - true: ranges that are too long by 3 cm, angles that are too large by a thousandth.
TEST(MountingReport, RangeAndScanAngle) {
  CalibrationResult result = calibration(0, 0, 0);
  result[SystemParameter::range_bias].bias = 0.03;
  result[SystemParameter::scan_angle_scale].bias = 0.001;
  const MountingReport report = reportMounting(result, "c.json", arcsecInput({0, 0, 0}));
  EXPECT_DOUBLE_EQ(report.range_correction, -0.03);
  EXPECT_DOUBLE_EQ(report.scan_angle_factor, 1.0 / 1.001);
  EXPECT_NE(mountingText(report).find("0.0300 m too long; add -0.0300 m"), std::string::npos);
  EXPECT_NE(mountingText(report).find("too large; multiply"), std::string::npos);
}

TEST(MountingReport, ChoosesTheSystem) {
  CalibrationResult result = calibration(10, 20, 0.5);
  MountingInput input = arcsecInput({0, 0, 0});
  input.system = "left";
  EXPECT_EQ(refusal(result, input),
            "the calibration has no system 'left'; it has one without a name");
  for (const char* name : {"left", "right"}) {
    SystemEstimate system;
    system.group.name = name;
    system.parameters = result.parameters;
    result.systems.push_back(system);
  }
  result.systems[1].parameters[std::size_t(indexOf(SystemParameter::boresight_roll))].bias =
      -50.0 * kRadiansPerArcsec;
  result.systems[1].offset.z() = 0.1;
  const MountingReport left = reportMounting(result, "c.json", input);
  EXPECT_NEAR(left.correction.after.angles[0], -20.0, 0.01);
  EXPECT_NEAR(left.correction.covariance(0, 1), 6.0, 1e-3);
  EXPECT_FALSE(remarks(left, "first system only"));
  input.system = "right";
  const MountingReport right = reportMounting(result, "c.json", input);
  EXPECT_NEAR(right.correction.after.angles[0], 50.0, 0.01);
  EXPECT_NEAR(right.correction.covariance(0, 1), 0.0, 0.01);
  EXPECT_TRUE(remarks(right, "first system only"));
  EXPECT_TRUE(remarks(right, "offset by 0.000, 0.000, 0.100 m"));
  input.system.clear();
  EXPECT_EQ(refusal(result, input),
            "the calibration has several systems; name one of them: left, right");
  input.system = "middle";
  EXPECT_EQ(refusal(result, input), "the calibration has no system 'middle' (left, right)");
}

TEST(MountingReport, Remarks) {
  CalibrationResult result = calibration(0, 1000, 0);
  MountingInput input = arcsecInput({0, 0, 0});
  // 1000" turn a lever arm by 4.85 mm per metre.
  EXPECT_TRUE(remarks(reportMounting(result, "c.json", input), "by 4.85 mm per metre"));
  input.lever_arm = Eigen::Vector3d(0, 0, 2);
  EXPECT_TRUE(remarks(reportMounting(result, "c.json", input), "would be displaced by 9.7 mm"));
  result[SystemParameter::lever_arm_x].status = ParameterStatus::estimated;
  EXPECT_TRUE(reportMounting(result, "c.json", input).remarks.empty());
  result.attitude = AttitudeSource::points;
  EXPECT_TRUE(remarks(reportMounting(result, "c.json", input), "quasi-rigorous"));
  result.attitude = AttitudeSource::nominal;
  EXPECT_TRUE(remarks(reportMounting(result, "c.json", input), "sensor as level"));
  result.sources[indexOf(ErrorSource::time_offset)] = 0.001;
  EXPECT_TRUE(remarks(reportMounting(result, "c.json", input), "also corrects time_offset"));
  result[SystemParameter::boresight_pitch].determined = false;
  EXPECT_TRUE(
      remarks(reportMounting(result, "c.json", input), "boresight_pitch is not determined"));
  for (ParameterEstimate& estimate : result.parameters) estimate.status = ParameterStatus::fixed;
  EXPECT_FALSE(remarks(reportMounting(result, "c.json", input), "the rotation is unchanged"));
  result[SystemParameter::boresight_roll].bias = 0.0;
  EXPECT_TRUE(remarks(reportMounting(result, "c.json", input), "the rotation is unchanged"));
}

TEST(MountingReport, GimbalLockInTextAndFile) {
  const MountingReport report =
      reportMounting(calibration(0, 0, 0), "c.json", arcsecInput({10, 90, 0}));
  EXPECT_TRUE(remarks(report, "gimbal lock: "));
  EXPECT_NE(mountingText(report).find("|            - | arcsec |"), std::string::npos);
  const std::string json = mountingJson(report);
  EXPECT_NE(json.find("\"angles_std\": [\n   null,"), std::string::npos) << json;
  EXPECT_NE(json.find("\"lever_arm_m\": null"), std::string::npos);
  EXPECT_NE(json.find("\"lever_arm_to_add_m\""), std::string::npos);
}

}  // namespace
}  // namespace pcl_als
