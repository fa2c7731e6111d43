// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/coverage_count.h>
#include <pcl_als/trajectory/system_correction.h>
#include <pcl_als/trajectory/trajectory.h>
#include <pcl_als/trajectory/trajectory_screening.h>

#include "flights.h"

namespace pcl_als {
namespace {

using Samples = std::vector<TrajectorySample>;
using Indices = std::vector<std::size_t>;

constexpr double kDegree = kRadiansPerDegree;

/// With roll and pitch of two degrees and a heading that follows the course, up to a crab.
Samples withAttitude(Samples samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t a = i > 0 ? i - 1 : 0, b = std::min(i + 1, samples.size() - 1);
    const Eigen::Vector3d way = samples[b].position - samples[a].position;
    const double t = samples[i].time;
    samples[i].roll = 2.0 * kDegree * std::sin(0.7 * t);
    samples[i].pitch = 2.0 * kDegree * std::sin(0.9 * t);
    samples[i].heading = std::atan2(way.x(), way.y()) + 3.0 * kDegree * std::sin(0.2 * t);
  }
  return samples;
}

/// 100 s to the north at 20 Hz in map coordinates; the heading passes from 359 to 1 degree.
Samples straightFlight() {
  return withAttitude(
      test::sampled(test::straight(0.0, {500000.0, 5400000.0, 0.0}), 0.0, 100.0, 0.05));
}

void addNoise(Samples& samples, unsigned seed, double metres, double radians) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (TrajectorySample& s : samples) {
    for (int axis = 0; axis < 3; ++axis) s.position[axis] += metres * normal(random);
    for (double* angle : {&s.roll, &s.pitch, &s.heading}) *angle += radians * normal(random);
  }
}

TEST(TrajectoryScreening, FindsASampleOfZeros) {
  Samples samples = straightFlight();
  samples[908].position.setZero();
  samples[908].roll = samples[908].pitch = samples[908].heading = 0.0;
  const TrajectoryScreening screening = screenTrajectory(samples);
  EXPECT_EQ(screening.indices(), Indices{908});
  EXPECT_TRUE(screening.objection().empty());
  EXPECT_NE(screening.describe().find("sample 909"), std::string::npos) << screening.describe();
}

TEST(TrajectoryScreening, FindsAWrongHeading) {
  Samples samples = straightFlight();
  samples[700].heading += 90.0 * kDegree;
  const TrajectoryScreening screening = screenTrajectory(samples);
  EXPECT_EQ(screening.indices(), Indices{700});
  ASSERT_EQ(screening.outliers.size(), 1U);
  EXPECT_NEAR(screening.outliers[0].turn, 90.0 * kDegree, 1.0 * kDegree);
}

TEST(TrajectoryScreening, FindsAWrongTimeAndShortRuns) {
  Samples samples = straightFlight();
  samples[300].time += 3.0;
  for (const std::size_t i : {1000U, 1001U}) samples[i].position.x() += 40.0;
  for (std::size_t i = 1500; i < 1505; ++i) samples[i].position.z() -= 300.0;
  const TrajectoryScreening screening = screenTrajectory(samples);
  EXPECT_EQ(screening.indices(), (Indices{300, 1000, 1001, 1500, 1501, 1502, 1503, 1504}));
  EXPECT_TRUE(screening.objection().empty());
}

TEST(TrajectoryScreening, FindsTheFirstAndTheLastSample) {
  Samples samples = straightFlight();
  samples.front().position.y() += 500.0;
  samples.back().position.setZero();
  EXPECT_EQ(screenTrajectory(samples).indices(), (Indices{0, samples.size() - 1}));
}

TEST(TrajectoryScreening, RefusesWhatCannotBeBridged) {
  Samples samples = straightFlight();
  for (std::size_t i = 600; i < 700; ++i) samples[i].position.x() += 1000.0;  // 5 s
  const TrajectoryScreening screening = screenTrajectory(samples);
  EXPECT_TRUE(screening.outliers.empty());
  EXPECT_NE(screening.objection().find("sample 601 to sample 700"), std::string::npos)
      << screening.objection();
  EXPECT_THROW(Trajectory{samples}, InputError);

  samples = straightFlight();
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) samples[random() % samples.size()].position.x() += 200.0;
  EXPECT_FALSE(screenTrajectory(samples).objection().empty());
}

TEST(TrajectoryScreening, TheTrajectoryIsThatWithoutTheOutliers) {
  Samples samples = straightFlight();
  const Trajectory clean(samples);
  samples[908].position.setZero();
  const Trajectory repaired(samples);
  ASSERT_EQ(repaired.repairs().size(), 1U);
  EXPECT_EQ(repaired.size() + 1, clean.size());
  const double time = samples[908].time;
  SensorPose from_clean, from_repaired;
  std::size_t cursor = 0;
  ASSERT_TRUE(clean.poseAt(time, from_clean, cursor));
  ASSERT_TRUE(repaired.poseAt(time, from_repaired, cursor = 0));
  EXPECT_LT((from_repaired.position - from_clean.position).norm(), 1e-3);
  EXPECT_TRUE(clean.repairs().empty());
}

/// Flights without an error; none of their samples is an outlier.
class GoodFlight : public testing::TestWithParam<std::pair<const char*, Samples>> {};

TEST_P(GoodFlight, HasNoOutliers) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Samples samples = GetParam().second;
    if (seed > 0) addNoise(samples, seed, 0.02, 30.0 * kRadiansPerArcsec);
    const TrajectoryScreening screening = screenTrajectory(samples);
    EXPECT_TRUE(screening.empty()) << seed << ": " << screening.describe();
    EXPECT_TRUE(screening.objection().empty()) << screening.objection();
  }
}

Samples every(Samples samples, std::size_t n) {
  Samples some;
  for (std::size_t i = 0; i < samples.size(); i += n) some.push_back(samples[i]);
  return some;
}

/// A drone that flies 10 s, hovers and turns by 180 degrees within 2 s, and flies back.
Samples hovering() {
  Samples samples;
  for (int i = 0; i <= 600; ++i) {
    TrajectorySample s;
    s.time = 0.05 * i;
    const double out = std::min(s.time, 10.0), back = std::max(0.0, s.time - 20.0);
    s.position = {0.0, 8.0 * (out - back), 60.0};
    s.roll = s.pitch = 0.0;
    s.heading = kPi * std::clamp((s.time - 14.0) / 2.0, 0.0, 1.0);
    samples.push_back(s);
  }
  return samples;
}

/// Two lines an hour and 3 km apart; positions rounded to centimetres, angles to 0.01 degrees.
Samples twoLines() {
  Samples samples = straightFlight();
  for (TrajectorySample s : straightFlight()) {
    s.time += 3600.0;
    s.position.x() += 3000.0;
    samples.push_back(s);
  }
  for (TrajectorySample& s : samples) {
    for (int axis = 0; axis < 3; ++axis)
      s.position[axis] = 0.01 * std::round(100.0 * s.position[axis]);
    for (double* angle : {&s.roll, &s.pitch, &s.heading})
      *angle = 0.01 * kDegree * std::round(*angle / (0.01 * kDegree));
  }
  return samples;
}

Samples withAngleSteps() {
  Samples samples = straightFlight();
  for (TrajectorySample& s : samples) s.heading = std::remainder(s.heading + 4.0 * kPi, 2.0 * kPi);
  return samples;
}

INSTANTIATE_TEST_SUITE_P(
    All, GoodFlight,
    testing::Values(std::pair("straight", straightFlight()),
                    std::pair("1 Hz", every(straightFlight(), 20)),
                    std::pair("turn", withAttitude(test::sampled(test::circling, 0.0, 200.0, 0.1))),
                    std::pair("hovering", hovering()), std::pair("two lines", twoLines()),
                    std::pair("heading through north", withAngleSteps()),
                    std::pair("positions only",
                              test::sampled(test::straight(30.0), 0.0, 50.0, 0.5))),
    [](const auto& info) {
      std::string name = info.param.first;
      for (char& c : name)
        if (c == ' ') c = '_';
      return name;
    });

TEST(CorrectionSizes, OfBiasesDifferByTheRangesOnly) {
  CorrectionSizes sizes;
  for (int i = 0; i < 1000; ++i) sizes.add(0.001 * i, 0.0, 0.1, i);
  EXPECT_EQ(sizes.count(), 1000U);
  EXPECT_NEAR(sizes.largest(), 1.004, 1e-3);
  EXPECT_GE(sizes.typical(), 0.9);          // nine tenths are below 0.91 m
  EXPECT_LE(sizes.typical(), 0.91 * 1.42);  // the edge of a class
  EXPECT_EQ(sizes.objection(), "");
}

TEST(CorrectionSizes, NameTheTimeOfOneThatBiasesCannotCause) {
  CorrectionSizes first, second;
  for (int i = 0; i < 1000; ++i) first.add(0.4, 0.0, 0.0, i);
  second.add(884.0, 0.0, 0.0, 123.5);
  second.merge(first);
  EXPECT_NE(second.objection().find("123.500 s"), std::string::npos) << second.objection();
  EXPECT_NE(second.objection().find("884 m"), std::string::npos) << second.objection();
  // Where most are wrong there is nothing to compare with.
  CorrectionSizes all;
  for (int i = 0; i < 10; ++i) all.add(0.0, 1200.0, 0.0, i);
  EXPECT_FALSE(all.objection().empty());
}

TEST(CorrectionSizes, ZeroAndNoneAreNoObjection) {
  CorrectionSizes sizes;
  EXPECT_EQ(sizes.objection(), "");
  sizes.add(0.0, 0.0, 0.0, 1.0);
  EXPECT_EQ(sizes.count(), 0U);
  EXPECT_EQ(sizes.typical(), 0.0);
}

/// The offset of a session is no sign of a wrong trajectory, however few points it has.
TEST(CorrectionSizes, LeaveOutTheOffsetsOfSystems) {
  CalibrationResult calibration;
  calibration.converged = true;
  calibration.systems.resize(2);
  for (SystemEstimate& system : calibration.systems)
    system.parameters[indexOf(SystemParameter::lever_arm_x)].bias = 0.01;
  calibration.systems[0].group.strips = {"1"};
  calibration.systems[1].group.strips = {"2"};
  calibration.systems[1].offset = {0.0, 0.0, 2.0};
  const SystemCorrection correction(calibration,
                                    std::make_shared<const Trajectory>(straightFlight()));

  constexpr std::size_t kCount = 100;
  const std::vector<double> time(kCount, 50.0), x(kCount, 500000.0), y(kCount, 5403000.0),
      z(kCount, 100.0);
  std::vector<double> dx(kCount), dy(kCount), dz(kCount);
  std::vector<std::uint16_t> source(kCount, 1);
  source[7] = 2;
  PointColumns points{time.data(), x.data(), y.data(), z.data()};
  points.source = source.data();
  CoverageCount coverage;
  correction.change(points, kCount, {dx.data(), dy.data(), dz.data()}, coverage);
  EXPECT_NEAR(dz[7], -2.0, 0.02);
  EXPECT_NEAR(dz[8], 0.0, 0.02);
  EXPECT_EQ(coverage.sizes.count(), kCount);
  EXPECT_EQ(coverage.sizes.objection(), "");
}

}  // namespace
}  // namespace pcl_als
