// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/source_effect.h>
#include <pcl_als/trajectory/system_correction.h>
#include <pcl_als/trajectory/trajectory_correction.h>

namespace pcl_als {
namespace {

constexpr double kSpeed = 60.0, kHeight = 1000.0;

/// North at 60 m/s with a roll of one degree and a period of four seconds.
std::shared_ptr<const Trajectory> rollingFlight(double roll) {
  std::vector<TrajectorySample> samples;
  for (double time = 0.0; time <= 20.0; time += 0.005) {
    TrajectorySample sample;
    sample.time = time;
    sample.position = {500.0, kSpeed * time, kHeight};
    sample.roll = roll * std::sin(0.5 * kPi * time);
    sample.pitch = 0.0;
    sample.heading = 0.0;
    samples.push_back(sample);
  }
  Trajectory::Options options;
  options.use_attitude = true;
  return std::make_shared<const Trajectory>(samples, options);
}

SensorPose poseAt(const Trajectory& flight, double time) {
  SensorPose pose;
  std::size_t cursor = 0;
  EXPECT_TRUE(flight.poseAt(time, pose, cursor));
  return pose;
}

SourceEffects effectsAt(const Trajectory& flight, const SourceReading& reading,
                        const Eigen::Vector3d& point, const ErrorSourceScale& scale) {
  const SensorPose pose = poseAt(flight, reading.time);
  SourceEffects effects = SourceEffects::Zero();
  SourceEffect(flight).add(reading, pose, scanGeometry(pose, point), scale, effects);
  return effects;
}

Eigen::Vector3d column(const SourceEffects& effects, ErrorSource source) {
  return effects.col(indexOf(source));
}

/// Level flight to the north; a point 300 m to the left (west) of it and 1000 m below.
TEST(SourceEffect, HasTheSignsOfHandComputedExamples) {
  const auto flight = rollingFlight(0.0);
  const Eigen::Vector3d point(200.0, 600.0, 0.0);
  const double range = std::hypot(300.0, kHeight), angle = std::atan2(300.0, kHeight);
  const ErrorSourceScale scale{angle, 100.0};
  const SourceEffects effects = effectsAt(*flight, {10.0, 1000.0F, 1}, point, scale);
  const Eigen::Vector3d beam(-300.0 / range, 0.0, -kHeight / range);
  // Left of the flight line a larger angle is further left and higher.
  const Eigen::Vector3d turned(-kHeight, 0.0, 300.0);
  const auto near = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - b).norm() < 1e-6 * (1.0 + b.norm());
  };
  EXPECT_TRUE(near(column(effects, ErrorSource::range_scale), range * beam));
  EXPECT_TRUE(near(column(effects, ErrorSource::time_offset), {0.0, kSpeed, 0.0}));
  EXPECT_TRUE(near(column(effects, ErrorSource::mirror_torsion), turned));
  EXPECT_TRUE(near(column(effects, ErrorSource::encoder_cubic), turned));      // P3(1) = 1
  EXPECT_TRUE(near(column(effects, ErrorSource::encoder_quadratic), turned));  // P2(1) = 1
  EXPECT_TRUE(near(column(effects, ErrorSource::intensity_ranging), std::log(10.0) * beam));
  EXPECT_TRUE(column(effects, ErrorSource::slope_ranging).isZero(0.0));
  EXPECT_TRUE(near(column(effects, ErrorSource::east_offset), {1.0, 0.0, 0.0}));
  EXPECT_TRUE(near(column(effects, ErrorSource::north_offset), {0.0, 1.0, 0.0}));
  EXPECT_TRUE(near(column(effects, ErrorSource::height_offset), {0.0, 0.0, 1.0}));
  const SourceEffects back = effectsAt(*flight, {10.0, 1000.0F, -1}, point, scale);
  EXPECT_TRUE(near(column(back, ErrorSource::mirror_torsion), -turned));
}

/// Level flight to the north; a point 300 m to the left of the sensor, 400 m ahead and 1000 m below
/// it: 500 m from the axis.
TEST(SourceEffect, OfTheDeflectionIsRadial) {
  const auto flight = rollingFlight(0.0);
  const Eigen::Vector3d sensor = poseAt(*flight, 10.0).position;
  const Eigen::Vector3d point = sensor + Eigen::Vector3d(-300.0, 400.0, -1000.0);
  ErrorSourceScale scale{0.5, 100.0};
  scale.about_axis = true;
  const SourceEffects effects = effectsAt(*flight, {10.0, 100.0F, 1}, point, scale);
  const double angle = std::atan2(500.0, 1000.0);
  const Eigen::Vector3d wanted = angle * Eigen::Vector3d(-600.0, 800.0, 500.0);
  EXPECT_LT((column(effects, ErrorSource::deflection_scale) - wanted).norm(), 1e-6);
  for (const ErrorSource of_mirror :
       {ErrorSource::mirror_torsion, ErrorSource::encoder_cubic, ErrorSource::encoder_quadratic})
    EXPECT_TRUE(column(effects, of_mirror).isZero(0.0));
  const SourceEffects linear = effectsAt(*flight, {10.0, 100.0F, 1}, point, {0.5, 100.0});
  EXPECT_TRUE(column(linear, ErrorSource::deflection_scale).isZero(0.0));
}

/// The columns of Eq. (8) and those of the sources describe the same geometry.
TEST(SourceEffect, AgreesWithTheDesignBlock) {
  const auto flight = rollingFlight(kRadiansPerDegree);
  const Eigen::Vector3d point(700.0, 560.0, 30.0);
  const SensorPose pose = poseAt(*flight, 9.3);
  const ScanGeometry geometry = scanGeometry(pose, point);
  const DesignBlock design = designBlock(geometry);
  const SourceEffects effects = effectsAt(*flight, {9.3, 50.0F, 1}, point, {0.4, 50.0});
  const Eigen::Vector3d by_scale = design.col(indexOf(SystemParameter::scan_angle_scale));
  const Eigen::Vector3d by_range = design.col(indexOf(SystemParameter::range_bias));
  EXPECT_LT((geometry.beta * column(effects, ErrorSource::mirror_torsion) - by_scale).norm(),
            1e-9 * by_scale.norm());
  EXPECT_LT((column(effects, ErrorSource::range_scale) - geometry.range() * by_range).norm(), 1e-9);
}

/// Points delivered with the pose of a wrong time, moved back by the correction.
TEST(SystemCorrection, RemovesATimeOffset) {
  constexpr double kOffset = 0.002;  // seconds
  const auto flight = rollingFlight(kRadiansPerDegree);
  CalibrationResult calibration;
  calibration.attitude = AttitudeSource::trajectory;
  calibration.sources[indexOf(ErrorSource::time_offset)] = kOffset;
  const SystemCorrection correction(calibration, flight);
  double largest = 0.0, before = 0.0;
  for (double time = 1.0; time < 19.0; time += 0.37) {
    const Eigen::Vector3d body(300.0 * std::sin(5.0 * time), 0.0, -kHeight);
    const SensorPose fired = poseAt(*flight, time - kOffset), tagged = poseAt(*flight, time);
    const Eigen::Vector3d truth = fired.position + fired.rotation * body;
    Eigen::Vector3d point = tagged.position + tagged.rotation * body;
    before = std::max(before, (point - truth).norm());
    Eigen::Vector3d change;
    CoverageCount coverage;
    correction.change({&time, &point.x(), &point.y(), &point.z()}, 1,
                      {&change.x(), &change.y(), &change.z()}, coverage);
    largest = std::max(largest, (point + change - truth).norm());
  }
  EXPECT_GT(before, 0.1);
  // Second order: half the acceleration of a point, 0.043 rad/s^2 at 1000 m, times the squared
  // offset, and the step of 5 ms of the velocity.
  EXPECT_LT(largest, 1e-3);
}

/// An offset of the block moves points and trajectory alike: assumed - true is taken away.
TEST(SystemCorrection, RemovesTheOffsetOfTheBlock) {
  const auto flight = rollingFlight(kRadiansPerDegree);
  CalibrationResult calibration;
  calibration.attitude = AttitudeSource::trajectory;
  calibration.sources[indexOf(ErrorSource::east_offset)] = 0.6;
  calibration.sources[indexOf(ErrorSource::north_offset)] = -0.4;
  calibration.sources[indexOf(ErrorSource::height_offset)] = -0.3;
  const Eigen::Vector3d wanted(-0.6, 0.4, 0.3);
  const SystemCorrection correction(calibration, flight);
  const double time = 10.0, x = 700.0, y = 600.0, z = 0.0;
  Eigen::Vector3d change;
  CoverageCount coverage;
  correction.change({&time, &x, &y, &z}, 1, {&change.x(), &change.y(), &change.z()}, coverage);
  EXPECT_LT((change - wanted).norm(), 1e-12);
  TrajectorySample sample;
  sample.time = time;
  sample.position = {500.0, kSpeed * time, kHeight};
  sample.roll = sample.pitch = sample.heading = 0.0;
  const auto corrected = correctTrajectory({sample}, calibration, flight, {});
  ASSERT_EQ(corrected.samples.size(), 1U);
  EXPECT_LT((corrected.samples[0].position - sample.position - wanted).norm(), 1e-12);
}

/// What a correction needs of the points is asked for and not excluded silently.
TEST(SystemCorrection, RefusesPointsWithoutWhatItNeeds) {
  const auto flight = rollingFlight(0.0);
  CalibrationResult calibration;
  calibration.attitude = AttitudeSource::trajectory;
  calibration.source_scale = {0.4, 100.0};
  const double time = 10.0, x = 600.0, y = 600.0, z = 0.0;
  Eigen::Vector3d change;
  const EffectColumns columns{&change.x(), &change.y(), &change.z()};
  CoverageCount coverage;
  for (const ErrorSource source : {ErrorSource::intensity_ranging, ErrorSource::mirror_torsion}) {
    calibration.sources.setZero();
    calibration.sources[indexOf(source)] = 1e-3;
    const SystemCorrection correction(calibration, flight);
    EXPECT_THROW(correction.change({&time, &x, &y, &z}, 1, columns, coverage), UsageError);
    const float intensity = 1000.0F;
    const std::int8_t scan_direction = 1;
    correction.change({&time, &x, &y, &z, &intensity, &scan_direction}, 1, columns, coverage);
    EXPECT_GT(change.norm(), 1e-4);
  }
}

}  // namespace
}  // namespace pcl_als
