// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/filters/impl/intensity_correction.hpp>
#include <pcl_als/radiometry/atmosphere.h>

#include "simulated_strips.h"

/// A point of a user's own, with what the filter needs.
struct IntensityPoint {
  PCL_ADD_POINT4D;
  float intensity = 0.0F;
  double gps_time = 0.0;
  std::uint8_t return_number = 1, number_of_returns = 1;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};
POINT_CLOUD_REGISTER_POINT_STRUCT(
    IntensityPoint, (float, x, x)(float, y, y)(float, z, z)(float, intensity, intensity)(
                        double, gps_time, gps_time)(std::uint8_t, return_number,
                                                    return_number)(std::uint8_t, number_of_returns,
                                                                   number_of_returns))

namespace pcl_als {
namespace {

using Cloud = pcl::PointCloud<PointLidar>;

/// 1000 m above the frame's origin, north at 50 m/s, t = 0 to 20.
std::shared_ptr<const Trajectory> flightOverFrame() {
  std::vector<TrajectorySample> samples(2);
  samples[0].position = {700000.0, 5660000.0, 1000.0};
  samples[1].position = {700000.0, 5661000.0, 1000.0};
  samples[1].time = 20.0;
  Trajectory::Options options;
  options.gap_threshold = 100.0;
  return std::make_shared<const Trajectory>(samples, options);
}

LocalFrame frame() {
  LocalFrame frame;
  frame.origin = {700000.0, 5660500.0, 0.0};
  return frame;
}

/// Level ground below the sensor at t = 10, intensity 100 everywhere.
Cloud::Ptr ground() {
  Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < 400; ++i) {
    PointLidar point(0.5F * static_cast<float>(i % 20), 0.5F * static_cast<float>(i / 20), 0.0F);
    point.gps_time = 10.0;
    point.intensity = 100.0F;
    point.point_source_id = 7;
    point.classification = 2;
    cloud->push_back(point);
  }
  return cloud;
}

IntensityCorrection<PointLidar> filterOf(const Cloud::Ptr& cloud) {
  IntensityCorrection<PointLidar> filter;
  filter.setTrajectory(flightOverFrame());
  filter.setLocalFrame(frame());
  RadiometricModel model;
  model.reference_range = 500.0;
  filter.setModel(model);
  filter.setInputCloud(cloud);
  return filter;
}

TEST(IntensityCorrection, LevelGroundBelowTheSensorByHand) {
  const Cloud::Ptr cloud = ground();
  auto filter = filterOf(cloud);
  Cloud corrected;
  filter.filter(corrected);
  // 1000 m against 500 m: times 4. A point 13.4 m aside: (1000.09/500)^2 / 0.9999 = 4.0011.
  EXPECT_NEAR(corrected[0].intensity, 400.0F, 1e-3F);
  EXPECT_NEAR(corrected[399].intensity, 400.108F, 1e-2F);
  EXPECT_EQ(filter.getCounts()[0], 400U);
  EXPECT_EQ((*cloud)[0].intensity, 100.0F);  // the input is as it was
  EXPECT_EQ(corrected[5].point_source_id, 7);
  EXPECT_EQ(corrected[5].gps_time, 10.0);
  EXPECT_EQ(corrected[5].x, (*cloud)[5].x);
  EXPECT_NEAR(filter.getRadiometry()[0].range, 1000.0F, 1e-3F);
}

TEST(IntensityCorrection, ReadsUnixTimesInMicroseconds) {
  const Cloud::Ptr cloud = ground();
  Cloud expected, found;
  filterOf(cloud).filter(expected);
  for (PointLidar& point : *cloud) point.gps_time = 1e6 * (1756080000.0 + point.gps_time);
  auto filter = filterOf(cloud);
  TimeAlignment alignment;
  alignment.offset = -1756080000.0;
  filter.setTimeAlignment(alignment);
  filter.filter(found);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    EXPECT_FLOAT_EQ(found[i].intensity, expected[i].intensity);
  EXPECT_NE(expected.front().intensity, cloud->front().intensity);
}

TEST(IntensityCorrection, GivenNormalsAreUsedAndNanMeansNone) {
  const Cloud::Ptr cloud = ground();
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  normals->resize(cloud->size(), pcl::Normal(0.6F, 0.0F, 0.8F));
  (*normals)[1] = pcl::Normal(NAN, NAN, NAN);
  auto filter = filterOf(cloud);
  filter.setInputNormals(normals);
  Cloud corrected;
  filter.filter(corrected);
  EXPECT_NEAR(corrected[0].intensity, 500.0F, 1e-2F);  // 400 / 0.8
  EXPECT_NEAR(corrected[1].intensity, 400.0F, 1e-2F);
  EXPECT_EQ(filter.getCounts()[static_cast<std::size_t>(RadiometryStatus::no_surface)], 1U);
  normals->resize(3);
  EXPECT_THROW(filter.filter(corrected), UsageError);
}

TEST(IntensityCorrection, PointsThatCannotBeServed) {
  const Cloud::Ptr cloud = ground();
  (*cloud)[0].x = NAN;
  (*cloud)[1].z = 1200.0F;  // above the sensor
  (*cloud)[2].intensity = 0.0F;
  (*cloud)[3].number_of_returns = 3;
  Cloud corrected;
  auto filter = filterOf(cloud);
  filter.filter(corrected);
  EXPECT_EQ(corrected[0].intensity, 100.0F);
  EXPECT_EQ(corrected[1].intensity, 100.0F);
  EXPECT_EQ(corrected[2].intensity, 0.0F);
  EXPECT_EQ(filter.getCounts()[static_cast<std::size_t>(RadiometryStatus::partial)], 1U);
  (*cloud)[4].gps_time = 99.0;
  EXPECT_THROW(filter.filter(corrected), InputError);
  filter.setKeepUncovered(true);
  filter.filter(corrected);
  EXPECT_EQ(corrected[4].intensity, 100.0F);
  EXPECT_EQ(filter.getCounts()[static_cast<std::size_t>(RadiometryStatus::uncovered)], 1U);
}

TEST(IntensityCorrection, RefusesWhatIsNotSet) {
  const Cloud::Ptr cloud = ground();
  Cloud corrected;
  IntensityCorrection<PointLidar> none;
  none.setInputCloud(cloud);
  EXPECT_THROW(none.filter(corrected), UsageError);
  auto filter = filterOf(cloud);
  filter.setGain(0.0);
  EXPECT_THROW(filter.filter(corrected), UsageError);
}

TEST(IntensityCorrection, EmptyAndLonePoints) {
  Cloud corrected;
  const Cloud::Ptr empty(new Cloud);
  filterOf(empty).filter(corrected);
  EXPECT_TRUE(corrected.empty());
  const Cloud::Ptr lone(new Cloud);
  lone->push_back((*ground())[0]);
  auto filter = filterOf(lone);
  filter.filter(corrected);
  EXPECT_NEAR(corrected[0].intensity, 400.0F, 1e-3F);  // no plane: range only
  EXPECT_EQ(filter.getCounts()[static_cast<std::size_t>(RadiometryStatus::no_surface)], 1U);
}

TEST(IntensityCorrection, TakesAUsersPoint) {
  pcl::PointCloud<IntensityPoint>::Ptr cloud(new pcl::PointCloud<IntensityPoint>);
  const Cloud::ConstPtr level = ground();
  for (const PointLidar& p : *level) {
    IntensityPoint point;
    point.x = p.x, point.y = p.y, point.z = p.z;
    point.intensity = 100.0F;
    point.gps_time = p.gps_time;
    cloud->push_back(point);
  }
  IntensityCorrection<IntensityPoint> filter;
  filter.setTrajectory(flightOverFrame());
  filter.setLocalFrame(frame());
  filter.setGain(2.0);
  filter.setInputCloud(cloud);
  pcl::PointCloud<IntensityPoint> corrected;
  filter.filter(corrected);
  EXPECT_NEAR(corrected[0].intensity, 50.0F, 1e-3F);
}

simulation::SimulationOptions blockOptions() {
  auto options = simulation::SimulationOptions::preset("small", 0.3, 0.5);
  options.noise = simulation::NoiseOptions::named("range");
  options.bias.setZero();
  options.atmosphere.visibility_km = 8.0;
  return options;
}

RadiometricModel modelOf(const simulation::SimulationOptions& options) {
  Atmosphere air;
  air.visibility_km = options.atmosphere.visibility_km;
  air.temperature_c = options.atmosphere.temperature_c;
  air.pressure_kpa = options.atmosphere.pressure_kpa;
  air.relative_humidity = 0.0;  // the simulated air has no vapour
  RadiometricModel model;
  model.extinction_per_km = extinctionOf(air).total();
  return model;
}

TEST(IntensityCorrection, IsProportionalToReflectanceOverStripsAndHeights) {
  const auto options = blockOptions();
  const test::SimulatedStrips block(options);
  std::vector<double> before, after;
  std::vector<std::vector<double>> by_strip;
  for (const test::SimulatedStrip& simulated : block.strips) {
    IntensityCorrection<PointLidar> filter;
    filter.setTrajectory(block.flight);
    filter.setModel(modelOf(options));
    filter.setLocalFrame(simulated.strip.frame);
    filter.setInputCloud(simulated.strip.cloud);
    Cloud corrected;
    filter.filter(corrected);
    auto& strip = by_strip.emplace_back();
    for (std::size_t i = 0; i < corrected.size(); ++i) {
      const PointRadiometry& found = filter.getRadiometry()[i];
      const PointLidar& given = (*simulated.strip.cloud)[i];
      if (found.status != RadiometryStatus::surface || given.number_of_returns > 1 ||
          given.classification == 5 || found.incidence > 60.0F * kRadiansPerDegree)
        continue;
      before.push_back(given.intensity / simulated.reflectance[i]);
      after.push_back(corrected[i].intensity / simulated.reflectance[i]);
      strip.push_back(after.back());
    }
  }
  // A full, white, perpendicular target at 1000 m has the gain, in the air of one kilometre.
  const double constant =
      options.scanner.gain * twoWayTransmission(modelOf(options).extinction_per_km, 1000.0);
  std::size_t within = 0;
  for (const double value : after) within += std::abs(value / constant - 1.0) <= 0.02;
  EXPECT_GT(static_cast<double>(within), 0.99 * static_cast<double>(after.size()));
  for (std::vector<double>& strip : by_strip)
    EXPECT_NEAR(medianInPlace(strip) / constant, 1.0, 0.005);
  // Before, the heights alone make a factor of five.
  std::sort(before.begin(), before.end());
  EXPECT_GT(before[before.size() * 9 / 10], 3.0 * before[before.size() / 10]);
}

TEST(IntensityCorrection, OneThreadEqualsEight) {
  const test::SimulatedStrips block(blockOptions());
  const test::SimulatedStrip& simulated = block.strips[2];
  Cloud one, eight;
  for (Cloud* out : {&one, &eight}) {
    IntensityCorrection<PointLidar> filter;
    filter.setTrajectory(block.flight);
    filter.setModel(modelOf(blockOptions()));
    filter.setLocalFrame(simulated.strip.frame);
    filter.setNumberOfThreads(out == &one ? 1 : 8);
    filter.setInputCloud(simulated.strip.cloud);
    filter.filter(*out);
  }
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i].intensity, eight[i].intensity);
}

}  // namespace
}  // namespace pcl_als
