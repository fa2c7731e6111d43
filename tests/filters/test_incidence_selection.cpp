// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/impl/incidence_selection.hpp>

#include "filter_checks.h"
#include "own_point.h"

namespace pcl_als {
namespace {

using test::frameAt;
using test::kNaN;
using test::setOf;
using Cloud = pcl::PointCloud<PointLidar>;

/// 1000 m above the origin of the frame at t = 10 s, north at 50 m/s, t = 0 to 20.
std::shared_ptr<const Trajectory> flightOverPatches() {
  std::vector<TrajectorySample> samples(2);
  samples[0].position = {432000.0, 5449500.0, 1000.0};
  samples[1].position = {432000.0, 5450500.0, 1000.0};
  samples[1].time = 20.0;
  Trajectory::Options options;
  options.gap_threshold = 100.0;
  return std::make_shared<const Trajectory>(samples, options);
}

/// A row of patches of level ground, from 0 to 600 m east of the flight line, measured at t = 10.
Cloud::Ptr row() {
  Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < 1200; ++i) {
    for (int k = -4; k <= 4; ++k) {
      cloud->emplace_back(0.5F * static_cast<float>(i), 0.5F * static_cast<float>(k), 0.0F);
      cloud->back().gps_time = 10.0;
    }
  }
  return cloud;
}

template <typename PointT>
IncidenceSelection<PointT> incidenceOf(const typename pcl::PointCloud<PointT>::ConstPtr& cloud,
                                       bool removed = false) {
  IncidenceSelection<PointT> incidence(removed);
  incidence.setInputCloud(cloud);
  incidence.setLocalFrame(frameAt(432000.0, 5450000.0));
  incidence.setTrajectory(flightOverPatches());
  incidence.setAngleLimits(10.0, 20.0);
  return incidence;
}

TEST(IncidenceSelection, EqualsTheAngleOfLevelGround) {
  const Cloud::Ptr cloud = row();
  auto incidence = incidenceOf<PointLidar>(cloud, true);
  pcl::Indices indices;
  incidence.filter(indices);
  const std::set<int> selected = setOf(indices);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const PointLidar& p = (*cloud)[i];
    // The angle at the sensor, which over level ground is that of incidence.
    const double angle = std::atan(std::hypot(p.x, p.y) / 1000.0) / kRadiansPerDegree;
    EXPECT_NEAR(incidence.getAngles()[i], angle, 1e-3);  // normals are floats
    if (std::abs(angle - 10.0) < 1e-3 || std::abs(angle - 20.0) < 1e-3) continue;
    EXPECT_EQ(selected.count(static_cast<int>(i)) > 0, angle > 10.0 && angle < 20.0);
  }
  EXPECT_EQ(indices.size() + incidence.getRemovedIndices()->size(), cloud->size());
  incidence.setNegative(true);
  incidence.setNumberOfThreads(4);
  pcl::Indices inverted;
  incidence.filter(inverted);
  EXPECT_EQ(indices.size() + inverted.size(), cloud->size());
}

TEST(IncidenceSelection, ReadsUnixTimesInMilliseconds) {
  const Cloud::Ptr cloud = row();
  pcl::Indices expected, found;
  incidenceOf<PointLidar>(cloud).filter(expected);
  for (PointLidar& point : *cloud) point.gps_time = 1e3 * (1756080000.0 + point.gps_time);
  auto incidence = incidenceOf<PointLidar>(cloud);
  TimeAlignment alignment;
  alignment.offset = -1756080000.0;
  incidence.setTimeAlignment(alignment);
  incidence.filter(found);
  EXPECT_EQ(found, expected);
  EXPECT_FALSE(expected.empty());
}

TEST(IncidenceSelection, TakesNormalsOfTheUserAndPointTypesOfTheirOwn) {
  const Cloud::Ptr cloud = row();
  // A slope of 15 degrees that faces the flight line at x = 0: incidence is 15 - the angle there.
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  const auto tilt = static_cast<float>(15.0 * kRadiansPerDegree);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    normals->push_back(pcl::Normal(-std::sin(tilt), 0.0F, std::cos(tilt)));
  normals->at(4) = pcl::Normal(kNaN, kNaN, kNaN);
  auto incidence = incidenceOf<test::OwnPoint>(test::cloudOf<test::OwnPoint>(*cloud));
  incidence.setInputNormals(normals);
  pcl::Indices indices;
  incidence.filter(indices);
  EXPECT_NEAR(incidence.getAngles()[13], 15.0 - std::atan(0.0005) / kRadiansPerDegree, 1e-3);
  EXPECT_TRUE(std::isnan(incidence.getAngles()[4]));
  EXPECT_EQ(setOf(indices).count(13), 1U);
  EXPECT_EQ(setOf(indices).count(4), 0U);
  normals->points.resize(10);
  EXPECT_THROW(incidence.filter(indices), UsageError);
}

TEST(IncidenceSelection, PointsWithoutAnAngleAreNotSelected) {
  const Cloud::Ptr cloud = row();
  auto incidence = incidenceOf<PointLidar>(cloud);
  incidence.setAngleLimits(0.0, 90.0);
  cloud->at(400).gps_time = 100.0;  // after the flight
  cloud->at(500).number_of_returns = 2;
  cloud->at(600).x = kNaN;
  pcl::Indices indices;
  incidence.filter(indices);
  for (const int index : {400, 500, 600}) EXPECT_EQ(setOf(indices).count(index), 0U) << index;
  EXPECT_EQ(indices.size(), cloud->size() - 3);
  EXPECT_EQ(incidence.getUncovered(), 1U);
  TimeAlignment alignment;
  alignment.offset = 1000.0;
  incidence.setTimeAlignment(alignment);
  EXPECT_THROW(incidence.filter(indices), InputError);
}

TEST(IncidenceSelection, RefusesWhatIsMissingOrImpossible) {
  IncidenceSelection<PointLidar> incidence;
  EXPECT_THROW(incidence.setAngleLimits(20.0, 10.0), UsageError);
  EXPECT_THROW(incidence.setAngleLimits(0.0, 91.0), UsageError);
  EXPECT_THROW(incidence.setAngleLimits(kNaN, 20.0), UsageError);
  pcl::Indices indices{1};
  incidence.setInputCloud(Cloud::Ptr(new Cloud));
  EXPECT_THROW(incidence.filter(indices), UsageError);
  incidence.setTrajectory(flightOverPatches());
  incidence.filter(indices);
  EXPECT_TRUE(indices.empty());
}

}  // namespace
}  // namespace pcl_als
