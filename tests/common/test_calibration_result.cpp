// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {
namespace {

StripErrors strip(const std::string& id, double from, double to) {
  TrajectoryErrorKnot first, last;
  first.time = from, last.time = to;
  return {id, {first, last}, {}};
}

TEST(CalibrationResult, BelongsToTheFlightThatItsStripsWereMeasuredIn) {
  CalibrationResult calibration;
  EXPECT_FALSE(isOfAnotherFlight(calibration, 0.0, 1.0));  // nothing is known of its flight
  calibration.strip_errors = {strip("1", 100.0, 200.0), {"2", {}, {}}, strip("3", 1000.0, 1100.0)};
  EXPECT_FALSE(isOfAnotherFlight(calibration, 50.0, 2000.0));
  EXPECT_FALSE(isOfAnotherFlight(calibration, 150.0, 160.0));
  EXPECT_FALSE(isOfAnotherFlight(calibration, 201.0,
                                 300.0));  // within RecoveredAttitude::kMaximumExtrapolation
  EXPECT_TRUE(isOfAnotherFlight(calibration, 300.0, 900.0));  // between two sessions
  EXPECT_TRUE(isOfAnotherFlight(calibration, 5000.0, 6000.0));
  calibration.recovered_attitude.addPass({{5500.0, {}}});
  EXPECT_FALSE(isOfAnotherFlight(calibration, 5000.0, 6000.0));
  calibration.strip_errors.clear();
  EXPECT_TRUE(isOfAnotherFlight(calibration, 150.0, 160.0));
}

TEST(CalibrationResult, TheInstrumentPartHoldsNothingOfTheFlight) {
  CalibrationResult calibration;
  calibration.verdict.downgrade(CalibrationStatus::no_improvement, "reason");
  calibration.attitude = AttitudeSource::points;
  calibration[SystemParameter::range_bias].bias = 0.1;
  calibration.systems.resize(2);
  calibration.channel_field = "beam";
  calibration.sources[0] = 0.5;
  calibration.scan_planes = {{0.6, 0.8, 0.0}};
  calibration.line_fit_half_width = 0.3;
  calibration.strip_errors = {strip("1", 100.0, 200.0)};
  calibration.recovered_attitude.addPass({{150.0, {}}});
  calibration.held = {{"fixed strips", {"4"}}};
  calibration.pairs.resize(3);
  const CalibrationResult instrument = instrumentOf(calibration);
  EXPECT_FALSE(instrument.verdict.usable());
  EXPECT_EQ(instrument.attitude, AttitudeSource::points);
  EXPECT_EQ(instrument.biases(), calibration.biases());
  EXPECT_EQ(instrument.systems.size(), 2U);
  EXPECT_EQ(instrument.channel_field, "beam");
  EXPECT_EQ(instrument.sources, calibration.sources);
  EXPECT_EQ(instrument.scan_planes, calibration.scan_planes);
  EXPECT_EQ(instrument.line_fit_half_width, 0.3);
  EXPECT_TRUE(instrument.strip_errors.empty());
  EXPECT_TRUE(instrument.recovered_attitude.empty());
  EXPECT_TRUE(instrument.held.empty());
  EXPECT_TRUE(instrument.pairs.empty());
  EXPECT_FALSE(isOfAnotherFlight(instrument, 0.0, 1.0));
}

TEST(CalibrationResult, ReportsBrieflyAndInFull) {
  CalibrationResult result;
  result[SystemParameter::boresight_roll] = {-90.0 * kRadiansPerArcsec, 0.5 * kRadiansPerArcsec,
                                             0.1, ParameterStatus::estimated, ""};
  result[SystemParameter::range_bias] = {0.12, 0.004, 0.001, ParameterStatus::estimated, ""};
  result.sigma0 = 1.05;
  result.iterations.resize(7);
  result.pairs = {{"1", "2", 500, 0.5, 0.02, -0.1, 1e-4}};
  EXPECT_EQ(result.briefReport(),
            "usable: boresight_roll -90.00 +- 0.50 arcsec, range_bias 0.1200 +- 0.0040 m, "
            "sigma0 1.050, 7 iterations");
  const std::string full = result.fullReport();
  for (const char* part : {"| boresight_roll     |       -90.00 |         0.50 |", "| 1 : 2 ",
                           "sigma0 1.050", "verdict: "})
    EXPECT_NE(full.find(part), std::string::npos) << part << '\n' << full;
}

}  // namespace
}  // namespace pcl_als
