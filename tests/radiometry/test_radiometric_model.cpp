// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/radiometry/radiometric_model.h>

namespace pcl_als {
namespace {

const double kOrigin[] = {700000.0, 5660000.0};  // UTM: floats would not do

/// Flies east along the origin's parallel at 1000 m, 50 m/s, from t = 0 to 20.
std::shared_ptr<const Trajectory> flightEast() {
  std::vector<TrajectorySample> samples;
  for (int i = 0; i <= 200; ++i) {
    TrajectorySample sample;
    sample.time = 0.1 * i;
    sample.position = {kOrigin[0] + 5.0 * i, kOrigin[1], 1000.0};
    samples.push_back(sample);
  }
  return std::make_shared<const Trajectory>(samples);
}

LidarReturn pointAt(double time, double east, double north, double up) {
  LidarReturn point;
  point.time = time;
  point.position = {kOrigin[0] + east, kOrigin[1] + north, up};
  return point;
}

LocalSurface level() {
  LocalSurface surface;
  surface.normal = Eigen::Vector3f::UnitZ();
  surface.support = 10;
  return surface;
}

TEST(RadiometricModel, FactorByHand) {
  RadiometricModel model;
  // (2000/1000)^2 / cos 60 = 8.
  EXPECT_NEAR(model.factor(2000.0, 0.5), 8.0, 1e-12);
  // No surface: range only.
  EXPECT_NEAR(model.factor(2000.0, NAN), 4.0, 1e-12);
  // 0.1 per km, 1 km more each way: exp(0.2) = 1.2214028.
  model.extinction_per_km = 0.1;
  EXPECT_NEAR(model.factor(2000.0, NAN), 4.0 * 1.2214028, 1e-6);
  // 500 m: exp(-0.1) / 4.
  EXPECT_NEAR(model.factor(500.0, NAN), 0.25 * 0.9048374, 1e-7);
  // At the reference range, normal to the beam, nothing changes.
  EXPECT_EQ(model.factor(1000.0, 1.0), 1.0);
}

TEST(RadiometricModel, TermsAreWeighedOneByOne) {
  RadiometricModel model;
  model.range_exponent = 0.0;
  EXPECT_NEAR(model.factor(2000.0, 0.5), 2.0, 1e-12);
  model.incidence_exponent = 0.0;
  EXPECT_EQ(model.factor(2000.0, 0.5), 1.0);
  model.range_exponent = 3.0;
  model.incidence_exponent = 0.5;
  EXPECT_NEAR(model.factor(2000.0, 0.25), 8.0 * 2.0, 1e-12);
}

TEST(RadiometricModel, RefusesWhatNoReceiverDoes) {
  for (const auto& spoil : {+[](RadiometricModel& m) { m.range_exponent = -1.0; },
                            +[](RadiometricModel& m) { m.incidence_exponent = NAN; },
                            +[](RadiometricModel& m) { m.extinction_per_km = -0.1; },
                            +[](RadiometricModel& m) { m.reference_range = 0.0; },
                            +[](RadiometricModel& m) { m.largest_incidence = 90.0; }}) {
    RadiometricModel model;
    spoil(model);
    EXPECT_THROW(model.check(), UsageError);
  }
}

TEST(RadiometricEvaluator, RangeAndIncidenceByHand) {
  const RadiometricEvaluator evaluator(flightEast(), RadiometricModel());
  RadiometryCursor cursor;
  // At t = 10 the sensor is 500 m east; a point 300 m north of it, 400 m below (600 m up): a
  // triangle of 300, 400, 500. Level ground: cos = 0.8.
  const PointRadiometry found =
      evaluator.evaluate(pointAt(10.0, 500.0, 300.0, 600.0), level(), cursor);
  EXPECT_EQ(found.status, RadiometryStatus::surface);
  EXPECT_NEAR(found.range, 500.0, 1e-4);
  EXPECT_NEAR(found.incidence, std::acos(0.8), 1e-6);
  EXPECT_NEAR(found.factor, 0.25 / 0.8, 1e-9);
}

TEST(RadiometricEvaluator, ASurfaceThatFacesTheSensorHasNoIncidence) {
  const RadiometricEvaluator evaluator(flightEast(), RadiometricModel());
  RadiometryCursor cursor;
  LocalSurface tilted = level();
  tilted.normal = Eigen::Vector3f(0.0F, -0.6F, 0.8F);  // towards the flight line
  const auto found = evaluator.evaluate(pointAt(10.0, 500.0, 300.0, 600.0), tilted, cursor);
  // A cosine that differs from 1 by a float's 6e-8 is an angle of 3.5e-4.
  EXPECT_NEAR(found.incidence, 0.0, 1e-3);
  EXPECT_NEAR(found.factor, 0.25, 1e-6);
}

TEST(RadiometricEvaluator, SteepIncidenceIsLimitedAndSaysSo) {
  RadiometricModel model;
  model.largest_incidence = 60.0;
  const RadiometricEvaluator evaluator(flightEast(), model);
  RadiometryCursor cursor;
  LocalSurface steep = level();
  steep.normal = Eigen::Vector3f(1.0F, 0.0F, 0.1F).normalized();  // 84 degrees from the beam
  const auto found = evaluator.evaluate(pointAt(10.0, 500.0, 0.0, 0.0), steep, cursor);
  EXPECT_EQ(found.status, RadiometryStatus::limited);
  EXPECT_NEAR(found.factor, 2.0, 1e-9);  // 1 / cos 60, not 1 / cos 84
  EXPECT_GT(found.incidence, 80.0 * kRadiansPerDegree);
}

TEST(RadiometricEvaluator, WithoutASurfaceOnlyRangeAndAtmosphere) {
  const RadiometricEvaluator evaluator(flightEast(), RadiometricModel());
  RadiometryCursor cursor;
  const LidarReturn point = pointAt(10.0, 500.0, 300.0, 600.0);
  auto found = evaluator.evaluate(point, LocalSurface(), cursor);
  EXPECT_EQ(found.status, RadiometryStatus::no_surface);
  EXPECT_NEAR(found.factor, 0.25, 1e-9);
  EXPECT_TRUE(std::isnan(found.incidence));
  LocalSurface unknown = level();
  unknown.normal.x() = NAN;
  EXPECT_EQ(evaluator.evaluate(point, unknown, cursor).status, RadiometryStatus::no_surface);
  LidarReturn first = point;
  first.number_of_returns = 2;  // the first of two: part of the energy went on
  found = evaluator.evaluate(first, level(), cursor);
  EXPECT_EQ(found.status, RadiometryStatus::partial);
  EXPECT_NEAR(found.factor, 0.25, 1e-9);
}

TEST(RadiometricEvaluator, WhatCannotBeServedStaysAsItIs) {
  const RadiometricEvaluator evaluator(flightEast(), RadiometricModel());
  RadiometryCursor cursor;
  const auto status = [&](const LidarReturn& point) {
    const PointRadiometry found = evaluator.evaluate(point, level(), cursor);
    EXPECT_EQ(found.factor, 1.0);
    EXPECT_FALSE(found.corrected());
    return found.status;
  };
  EXPECT_EQ(status(pointAt(30.0, 0.0, 0.0, 0.0)), RadiometryStatus::uncovered);
  EXPECT_EQ(status(pointAt(NAN, 0.0, 0.0, 0.0)), RadiometryStatus::uncovered);
  EXPECT_EQ(status(pointAt(10.0, 500.0, 0.0, 1000.0)), RadiometryStatus::above_sensor);
  EXPECT_EQ(status(pointAt(10.0, 500.0, 0.0, 1500.0)), RadiometryStatus::above_sensor);
  EXPECT_EQ(status(pointAt(10.0, NAN, 0.0, 0.0)), RadiometryStatus::not_finite);
  EXPECT_THROW(RadiometricEvaluator(nullptr, RadiometricModel()), UsageError);
}

}  // namespace
}  // namespace pcl_als
