// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/processing/impl/delivery_check.hpp>

#include "own_point.h"
#include "simulated_strips.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

simulation::SimulationOptions block() {
  simulation::SimulationOptions options = simulation::SimulationOptions::preset("small", 1.0, 0.7);
  options.noise = simulation::NoiseOptions::named("range");
  return options;
}

const test::SimulatedStrips& strips() {
  static const test::SimulatedStrips made(block());
  return made;
}

const std::vector<ControlPoint>& control() {
  static const std::vector<ControlPoint> points = simulation::Simulator(block()).controlPoints();
  return points;
}

/// Fewer points than usual: the time goes into them.
CheckSettings quickCheck() {
  CheckSettings settings;
  settings.selection.point_budget = 100'000;
  settings.control = control();
  return settings;
}

template <typename PointT>
CheckedBlock checked() {
  DeliveryCheck<PointT> check;
  for (const test::SimulatedStrip& made : strips().strips)
    check.addInputStrip(test::cloudOf<PointT>(*made.strip.cloud), made.strip.frame, made.strip.id);
  check.setTrajectory(strips().flight);
  check.setSettings(quickCheck());
  check.check();
  EXPECT_FALSE(check.getAreas().empty());
  return check.getResult();
}

const CheckedBlock& fromClouds() {
  static const CheckedBlock block = checked<PointLidar>();
  return block;
}

/// Everything that does not depend on the clock, to the last bit.
void expectEqualChecks(const CheckedBlock& one, const CheckedBlock& other) {
  EXPECT_EQ(textsOf(one.warnings), textsOf(other.warnings));
  EXPECT_EQ(one.roughness_limit, other.roughness_limit);
  ASSERT_EQ(one.strips.size(), other.strips.size());
  for (std::size_t i = 0; i < one.strips.size(); ++i) {
    EXPECT_EQ(one.strips[i].id, other.strips[i].id);
    EXPECT_EQ(one.strips[i].points, other.strips[i].points);
    EXPECT_EQ(one.strips[i].course, other.strips[i].course);
  }
  ASSERT_EQ(one.pairs.size(), other.pairs.size());
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    const CheckedPair &a = one.pairs[i], &b = other.pairs[i];
    EXPECT_EQ(a.a + ":" + a.b, b.a + ":" + b.b);
    EXPECT_EQ(a.assessment.vertical.rms, b.assessment.vertical.rms);
    EXPECT_EQ(a.assessment.vertical.mean, b.assessment.vertical.mean);
    EXPECT_EQ(a.assessment.normal.rms, b.assessment.normal.rms);
    ASSERT_EQ(a.alignment.has_value(), b.alignment.has_value());
    if (a.alignment) {
      EXPECT_EQ(a.alignment->sigma0, b.alignment->sigma0);
    }
    ASSERT_EQ(a.samples.size(), b.samples.size());
    for (std::size_t k = 0; k < a.samples.size(); ++k) {
      EXPECT_EQ(a.samples[k].vertical, b.samples[k].vertical);
      EXPECT_EQ(a.samples[k].scan_angle_a, b.samples[k].scan_angle_a);
    }
  }
  ASSERT_EQ(one.control.has_value(), other.control.has_value());
  ASSERT_EQ(one.control->differences.size(), other.control->differences.size());
  for (std::size_t i = 0; i < one.control->differences.size(); ++i)
    EXPECT_EQ(one.control->differences[i].above, other.control->differences[i].above);
}

TEST(DeliveryCheck, EqualsTheCheckOfPcdFilesToTheLastBit) {
  const fs::path folder = test::scratch("check_of_clouds");
  std::vector<std::string> files;
  for (const test::SimulatedStrip& made : strips().strips) {
    files.push_back((folder / ("strip" + made.strip.id + ".pcd")).string());
    savePcd(files.back(), made.strip);
  }
  SurveyReader survey(files, 0);
  DeliveryCheckOptions options;
  options.settings = quickCheck();
  const DeliveryCheckResult of_files = checkDelivery(survey, strips().flight, options);
  const CheckedBlock& of_clouds = fromClouds();
  ASSERT_FALSE(of_clouds.pairs.empty());
  EXPECT_GT(of_clouds.pairs.front().assessment.vertical.rms, 0.0);
  expectEqualChecks(of_files.block, of_clouds);
}

TEST(DeliveryCheck, TakesAPointTypeOfOnesOwn) {
  expectEqualChecks(checked<test::OwnPoint>(), fromClouds());  // without flags and scan angles
}

TEST(DeliveryCheck, NeedsNeitherTimesNorATrajectory) {
  DeliveryCheck<pcl::PointXYZ> check;
  for (const test::SimulatedStrip& made : strips().strips) {
    pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
    for (const PointLidar& p : *made.strip.cloud)
      if (p.number_of_returns == 1) cloud->emplace_back(p.x, p.y, p.z);
    check.addInputStrip(cloud, made.strip.frame, made.strip.id);
  }
  check.setSettings(quickCheck());
  check.check();
  ASSERT_FALSE(check.getResult().pairs.empty());
  // Without multiple returns the areas that are compared are others, of the same misfit.
  const double with_times = fromClouds().pairs.front().assessment.normal.rms;
  EXPECT_NEAR(check.getResult().pairs.front().assessment.normal.rms, with_times, 0.3 * with_times);
}

TEST(DeliveryCheck, RefusesWhatIsMissing) {
  DeliveryCheck<PointLidar> check;
  EXPECT_THROW(check.check(), UsageError);
  EXPECT_THROW(check.getResult(), UsageError);
  EXPECT_THROW(check.addInputStrip(nullptr, LocalFrame(), "1"), UsageError);
  check.addInputStrip(strips().strips.front().strip.cloud, strips().strips.front().strip.frame,
                      "1");
  EXPECT_THROW(check.check(), InputError);  // nothing to compare with
}

}  // namespace
}  // namespace pcl_als
