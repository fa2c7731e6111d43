// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// SystemCorrection builds the flight that a calibration needs from samples, and from any trajectory
// of the same flight; of a calibration of another flight it applies the instrument part.
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/system_correction.h>

#include "flights.h"

namespace pcl_als {
namespace {

using Samples = std::vector<TrajectorySample>;

/// A minute of a curve, from a time on, with an attitude that is not that of the line of flight.
Samples curve(double start = 0.0) {
  Samples samples = test::sampled(test::circling, 0.0, 60.0, 0.1);
  for (TrajectorySample& sample : samples) {
    sample.roll = 0.02;
    sample.pitch = 0.01 + 1e-4 * sample.time;
    sample.heading = 60.0 / 3000.0 * sample.time + 0.03;
    sample.time += start;
  }
  return samples;
}

CalibrationResult calibrated(AttitudeSource attitude) {
  CalibrationResult calibration;
  calibration.converged = true;
  calibration.attitude = attitude;
  calibration.line_fit_half_width = 3.0;
  calibration[SystemParameter::boresight_pitch].bias = 100.0 * kRadiansPerArcsec;
  calibration[SystemParameter::boresight_roll].bias = -60.0 * kRadiansPerArcsec;
  calibration[SystemParameter::boresight_heading].bias = 200.0 * kRadiansPerArcsec;
  calibration[SystemParameter::scan_angle_scale].bias = 1e-3;
  calibration.scan_planes = {{0.24, std::sqrt(1.0 - 0.24 * 0.24), 0.0},
                             {-0.24, std::sqrt(1.0 - 0.24 * 0.24), 0.0}};
  calibration.recovered_attitude.addPass(
      {{0.0, {0.01, -0.02}}, {30.0, {0.02, 0.03}}, {60.0, {0.0, 0.01}}});
  TrajectoryErrorKnot from, to;
  from.time = 0.0, to.time = 60.0;
  from.position = to.position = {0.1, 0.2, 0.3};
  calibration.strip_errors = {{"1", {from, to}, {}}};
  return calibration;
}

/// The displacements of points below the flight, one for every half second.
std::vector<Eigen::Vector3d> moved(const SystemCorrection& correction, double start = 0.0) {
  std::vector<double> time, axes[3], change[3];
  for (double t = 0.25; t < 60.0; t += 0.5) {
    const Eigen::Vector3d point =
        test::circling(t) + Eigen::Vector3d(400.0 * std::sin(t), 30.0, -1000.0);
    time.push_back(start + t);
    for (int axis = 0; axis < 3; ++axis) axes[axis].push_back(point[axis]);
  }
  for (std::vector<double>& column : change) column.resize(time.size());
  CoverageCount coverage;
  correction.change({time.data(), axes[0].data(), axes[1].data(), axes[2].data()}, time.size(),
                    {change[0].data(), change[1].data(), change[2].data()}, coverage);
  EXPECT_EQ(coverage.missed(), 0U);
  std::vector<Eigen::Vector3d> moved;
  for (std::size_t i = 0; i < time.size(); ++i)
    moved.emplace_back(change[0][i], change[1][i], change[2][i]);
  return moved;
}

double largestDifference(const std::vector<Eigen::Vector3d>& a,
                         const std::vector<Eigen::Vector3d>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

std::shared_ptr<const Trajectory> curvedFlight(const Trajectory::Options& options) {
  return std::make_shared<const Trajectory>(curve(), options);
}

TEST(SystemCorrection, UsesTheFlightAsTheCalibrationDoesWhateverItIsGiven) {
  for (const auto attitude : {AttitudeSource::none, AttitudeSource::points, AttitudeSource::nominal,
                              AttitudeSource::trajectory}) {
    SCOPED_TRACE(std::string(toString(attitude)));
    const CalibrationResult calibration = calibrated(attitude);
    const SystemCorrection from_samples(calibration, curve());
    EXPECT_EQ(from_samples.flight()->scanPlanes(), calibration.scan_planes);
    EXPECT_EQ(from_samples.flight()->lineFitHalfWidth(), 3.0);
    EXPECT_EQ(from_samples.flightRemark(), "");
    const std::vector<Eigen::Vector3d> expected = moved(from_samples);
    Trajectory::Options nominal, attitudes;
    nominal.nominal_attitude = true;
    attitudes.use_attitude = true;
    if (attitude == AttitudeSource::trajectory) {
      EXPECT_EQ(largestDifference(moved({calibration, curvedFlight(attitudes)}), expected), 0.0);
      EXPECT_THROW(SystemCorrection(calibration, curvedFlight({})), InputError);
      EXPECT_THROW(SystemCorrection(calibration, curvedFlight(nominal)), InputError);
      Samples incomplete = curve();
      incomplete[7].roll = std::nan("");
      EXPECT_THROW(SystemCorrection(calibration, incomplete), InputError);
      continue;
    }
    for (const Trajectory::Options& options : {Trajectory::Options(), nominal, attitudes})
      EXPECT_EQ(largestDifference(moved({calibration, curvedFlight(options)}), expected), 0.0);
  }
}

// The comparison above is worth something only where the models differ.
TEST(SystemCorrection, ModelsAndWindowsMakeADifference) {
  const auto with = [](AttitudeSource attitude, double half_width) {
    CalibrationResult calibration = calibrated(attitude);
    calibration.line_fit_half_width = half_width;
    return moved(SystemCorrection(calibration, curve()));
  };
  const auto none = with(AttitudeSource::none, 3.0);
  EXPECT_GT(largestDifference(none, with(AttitudeSource::none, 20.0)), 1e-4);
  EXPECT_GT(largestDifference(none, with(AttitudeSource::points, 3.0)), 1e-3);
  EXPECT_GT(largestDifference(none, with(AttitudeSource::nominal, 3.0)), 1e-3);
  EXPECT_GT(largestDifference(none, with(AttitudeSource::trajectory, 3.0)), 1e-3);
}

TEST(SystemCorrection, AppliesTheInstrumentPartToAnotherFlight) {
  constexpr double kLater = 5000.0;
  for (const auto attitude :
       {AttitudeSource::none, AttitudeSource::nominal, AttitudeSource::trajectory}) {
    const CalibrationResult calibration = calibrated(attitude);
    const SystemCorrection correction(calibration, curve(kLater));
    EXPECT_NE(correction.flightRemark().find("another flight"), std::string::npos);
    const SystemCorrection instrument(instrumentOf(calibration), curve(kLater));
    EXPECT_EQ(instrument.flightRemark(), "");
    EXPECT_EQ(largestDifference(moved(correction, kLater), moved(instrument, kLater)), 0.0);
    SystemCorrection::Options strips;
    strips.strip_corrections = true;
    EXPECT_NO_THROW(SystemCorrection(calibration, curve(), strips));
    EXPECT_THROW(SystemCorrection(calibration, curve(kLater), strips), InputError);
  }
}

TEST(SystemCorrection, NeedsTheAttitudeOfAnotherFlight) {
  constexpr double kLater = 5000.0;
  const CalibrationResult calibration = calibrated(AttitudeSource::points);
  EXPECT_THROW(SystemCorrection(calibration, curve(kLater)), InputError);
  SystemCorrection::Options options;
  options.fallback_attitude.addPass({{kLater, {0.01, -0.02}}, {kLater + 60.0, {0.01, -0.02}}});
  const SystemCorrection correction(calibration, curve(kLater), options);
  EXPECT_TRUE(correction.knowsAttitude(kLater + 30.0));
  EXPECT_FALSE(correction.knowsAttitude(30.0));
  EXPECT_GT(moved(correction, kLater).front().norm(), 0.1);
}

}  // namespace
}  // namespace pcl_als
