// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/trajectory_reconstruction.h>

#include "ray_flight.h"
#include "warning_texts.h"

namespace pcl_als {
namespace {

using test::isWarnedOf;
using test::pathOf;
using test::pathsOf;
using test::Points;
using test::RayFlight;
using test::wavy;
using test::wavyPath;

/// Root mean squares over time of errors, and of errors over their standard deviations.
struct Deviation {
  Eigen::Vector3d rms = Eigen::Vector3d::Zero(), normalised = Eigen::Vector3d::Zero();
};

Deviation deviation(const ReconstructedPath& path,
                    const std::function<Eigen::Vector3d(double)>& truth) {
  Deviation sum;
  for (const PathSample& sample : path.samples) {
    const Eigen::Array3d error = (sample.position - truth(sample.time)).array();
    sum.rms.array() += error.square();
    sum.normalised.array() += error.square() / sample.covariance.diagonal().array();
  }
  const auto n = static_cast<double>(path.samples.size());
  return {(sum.rms / n).cwiseSqrt(), (sum.normalised / n).cwiseSqrt()};
}

// 1 cm across a ray, 7 m between its returns, 1000 m: 2 m for a ray; 128 rays in a second.
TEST(TrajectoryReconstruction, FindsThePathFromRays) {
  const ReconstructedPath path = pathOf(wavy().points());
  ASSERT_TRUE(path.found) << path.reason;
  const Deviation is = deviation(path, wavyPath);
  EXPECT_LT(is.rms.head<2>().maxCoeff(), 0.4);
  EXPECT_LT(is.rms.z(), 1.0);
  EXPECT_FALSE(path.angles.used);
  EXPECT_NEAR(path.height, 1000.0, 5.0);
  EXPECT_NEAR(path.across, 0.01, 0.002);
}

// The standard deviation of an RMS over 20 flights with some ten independent values each is 5 %.
TEST(TrajectoryReconstruction, StandardDeviationsAreThoseOfTheErrors) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  constexpr int kSeeds = 20;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    RayFlight flight = wavy();
    flight.seed = seed;
    flight.trees = 0.05 + 0.01 * seed;
    squares += deviation(pathOf(flight.points()), wavyPath).normalised.cwiseAbs2() / kSeeds;
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(std::sqrt(squares[c]), 0.8) << c;
    EXPECT_LT(std::sqrt(squares[c]), 1.25) << c;
  }
}

TEST(TrajectoryReconstruction, FollowsATurn) {
  RayFlight flight;
  flight.path = [](double time) -> Eigen::Vector3d {
    const double turned = 0.02 * time;
    return {3000.0 * (1.0 - std::cos(turned)), 3000.0 * std::sin(turned), 800.0};
  };
  const ReconstructedPath path = pathOf(flight.points());
  ASSERT_TRUE(path.found);
  const Deviation is = deviation(path, flight.path);
  EXPECT_LT(is.normalised.maxCoeff(), 2.0);
  EXPECT_LT(is.rms.maxCoeff(), 1.0);
}

// Recorded angles are uncertain by half a percent: 5 m of the height of 1000 m, 1 degree across.
TEST(TrajectoryReconstruction, UsesScanAnglesWithoutSecondReturns) {
  for (const double step : {1.0, 0.006}) {
    for (const double sign : {1.0, -1.0}) {
      RayFlight flight = wavy();
      flight.trees = 0.0;
      flight.angle_step = step;
      flight.angle_sign = sign;
      const ReconstructedPath path = pathOf(flight.points());
      ASSERT_TRUE(path.found) << path.reason;
      EXPECT_TRUE(path.angles.used);
      EXPECT_EQ(path.angles.right_positive, sign > 0.0);
      const Deviation is = deviation(path, wavyPath);
      EXPECT_LT(is.rms.z(), 10.0);
      EXPECT_LT(is.rms.x(), 20.0);
      EXPECT_LT(is.normalised.maxCoeff(), 1.5);
      EXPECT_GT(path.meanStd().y(), 20.0) << "an unknown pitch of some degrees";
    }
  }
}

// Scan lines 14 degrees off the perpendicular (2026-11-23: their height was 3 % wrong, six standard
// deviations): the angle in the scan plane is larger than that across the course.
TEST(TrajectoryReconstruction, AllowsForSkewedScanLines) {
  RayFlight flight = wavy();
  flight.trees = 0.0;
  flight.course = 0.24;
  const ReconstructedPath path = pathOf(flight.points());
  ASSERT_TRUE(path.found) << path.reason;
  const Deviation is = deviation(path, wavyPath);
  EXPECT_LT(is.rms.z(), 15.0);
  EXPECT_LT(is.normalised.maxCoeff(), 2.0);
}

// A tile that a strip crosses in less than a second: its speed needs means of shorter times.
TEST(TrajectoryReconstruction, UsesScanAnglesOfShortTiles) {
  RayFlight flight = wavy();
  flight.trees = 0.0;
  flight.from = 4.1, flight.to = 4.9;
  const ReconstructedPath path = pathOf(flight.points());
  ASSERT_TRUE(path.found) << path.reason;
  EXPECT_LT(deviation(path, wavyPath).normalised.maxCoeff(), 2.0);
}

TEST(TrajectoryReconstruction, AllowsForRollInScanAngles) {
  RayFlight flight = wavy();
  flight.trees = 0.0;
  flight.angles_with_roll = false;
  flight.roll = [](double time) { return 0.02 * std::sin(1.1 * time); };
  const ReconstructedPath path = pathOf(flight.points());
  ASSERT_TRUE(path.found) << path.reason;
  EXPECT_GT(path.angles.roll, 0.005) << "RMS of the roll is 0.014";
  const Deviation is = deviation(path, wavyPath);
  // Errors of the offset and the scale are single values of a flight: 95 % within two.
  EXPECT_LT(is.normalised.x(), 2.0);
  EXPECT_LT(is.normalised.z(), 2.0);
}

TEST(TrajectoryReconstruction, ScanAnglesBridgeOpenGround) {
  RayFlight flight = wavy();
  flight.to = 60.0;
  Points points = flight.points();
  points.erase(
      std::remove_if(points.begin(), points.end(),
                     [](const LidarReturn& p) { return p.time > 8.0 && p.number_of_returns > 1; }),
      points.end());
  const ReconstructedPath path = pathOf(points);
  ASSERT_TRUE(path.found) << path.reason;
  EXPECT_TRUE(path.angles.used);
  EXPECT_GT(path.samples.back().covariance(1, 1), 100.0 * path.samples[40].covariance(1, 1));
  EXPECT_LT(deviation(path, wavyPath).normalised.maxCoeff(), 1.6);
}

// A drone, 75 m above open ground but for trees within eight seconds: elsewhere the pitch, of 1.5
// degrees on average, whose changes of 0.2 degrees are 0.26 m, shows the position along the course.
TEST(TrajectoryReconstruction, PitchOfTheScanLinesContinuesThePath) {
  double squares = 0.0, normalised = 0.0;
  constexpr int kSeeds = 6;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    RayFlight flight;
    flight.path = [seed](double time) -> Eigen::Vector3d {
      return {0.5 * std::sin(0.2 * time), 6.0 * time + 2.0 * std::sin(0.2 * time + seed), 75.0};
    };
    flight.pitch = [seed](double time) {
      return 0.026 + 0.005 * std::sin(0.8 * time + 2.0 * seed);
    };
    flight.to = 30.0;
    flight.noise = 3e-4;
    flight.seed = seed;
    flight.angle_step = 0.006;
    Points points = flight.points();
    points.erase(std::remove_if(points.begin(), points.end(),
                                [](const LidarReturn& p) {
                                  return p.number_of_returns > 1 &&
                                         (p.time < 14.0 || p.time > 22.0);
                                }),
                 points.end());
    const ReconstructedPath path = pathOf(points);
    ASSERT_TRUE(path.found) << path.reason;
    const Deviation is = deviation(path, flight.path);
    squares += is.rms.y() * is.rms.y() / kSeeds;
    normalised += is.normalised.y() * is.normalised.y() / kSeeds;
  }
  EXPECT_LT(std::sqrt(squares), 0.5);
  EXPECT_LT(std::sqrt(normalised), 1.25);
}

// Errors of a delivered trajectory walk by 0.3 mm in five milliseconds; knots do not follow.
TEST(TrajectoryReconstruction, AllowsForMovementsThatTheKnotsDoNotFollow) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  constexpr int kSeeds = 4;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 0.3e-3);
    std::vector<Eigen::Vector3d> walk(4200, Eigen::Vector3d::Zero());
    for (std::size_t i = 1; i < walk.size(); ++i)
      walk[i] = walk[i - 1] + Eigen::Vector3d(normal(random), normal(random), normal(random));
    RayFlight flight;
    flight.path = [&walk](double time) -> Eigen::Vector3d {
      return Eigen::Vector3d(0.0, 60.0 * time, 1000.0) +
             walk[static_cast<std::size_t>(std::max(0.0, time) / 0.005)];
    };
    flight.noise = 1e-4;
    flight.seed = seed;
    const ReconstructedPath path = pathOf(flight.points());
    ASSERT_TRUE(path.found) << path.reason;
    squares += deviation(path, flight.path).normalised.cwiseAbs2() / kSeeds;
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(std::sqrt(squares[c]), 0.7) << c;
    EXPECT_LT(std::sqrt(squares[c]), 1.3) << c;
  }
}

// Accelerations of some 0.3 m/s^2 per sqrt(Hz) make a path uncertain by 100 m after 70 seconds.
TEST(TrajectoryReconstruction, EndsWhereNothingShowsThePath) {
  RayFlight flight = wavy();
  flight.to = 150.0;
  flight.angle_step = 0.0;
  Points points = flight.points();
  for (LidarReturn& point : points)
    if (point.time > 10.0) point.return_number = point.number_of_returns = 1;
  points.erase(
      std::remove_if(points.begin(), points.end(),
                     [](const LidarReturn& p) { return p.time > 10.0 && p.position.z() > 1.0; }),
      points.end());
  const ReconstructedPath path = pathOf(points);
  ASSERT_TRUE(path.found);
  EXPECT_GT(path.samples.back().time, 10.0);
  EXPECT_LT(path.samples.back().time, 145.0);
  EXPECT_TRUE(isWarnedOf(path.warnings, "not determined for"));
}

TEST(TrajectoryReconstruction, SaysWhyThereIsNone) {
  RayFlight flight = wavy();
  flight.trees = 0.0;
  flight.angle_step = 0.0;
  const ReconstructedPath path = pathOf(flight.points());
  EXPECT_FALSE(path.found);
  EXPECT_NE(path.reason.find("no pulse has two returns"), std::string::npos) << path.reason;
  Points timeless = wavy().points();
  for (LidarReturn& point : timeless) point.time = 0.0;
  EXPECT_NE(pathOf(timeless).reason.find("no GPS times"), std::string::npos);
}

/// A tenth of the pulses are of other places.
TEST(TrajectoryReconstruction, RejectsRaysThatMissThePath) {
  RayFlight flight = wavy();
  Points points = flight.points();
  std::size_t i = 0;
  for (LidarReturn& point : points)
    if (point.number_of_returns == 2 && point.return_number == 1 && i++ % 10 == 0)
      point.position += Eigen::Vector3d(1.5, -2.0, 0.0);
  const ReconstructedPath path = pathOf(points);
  ASSERT_TRUE(path.found);
  EXPECT_GT(path.rejected, path.rays / 20);
  EXPECT_LT(deviation(path, wavyPath).normalised.maxCoeff(), 2.0);
}

TEST(TrajectoryReconstruction, DoesNotDependOnTheOrderOfPoints) {
  RayFlight flight = wavy();
  flight.to = 5.0;
  Points points = flight.points();
  const ReconstructedPath sorted = pathOf(points);
  std::shuffle(points.begin(), points.end(), std::mt19937(5));
  const ReconstructedPath shuffled = pathOf(points);
  ASSERT_EQ(sorted.rays, shuffled.rays);
  for (std::size_t i = 0; i < sorted.samples.size(); ++i)
    EXPECT_LT((sorted.samples[i].position - shuffled.samples[i].position).norm(), 1e-3);
}

// Channels that fire at one time look to different places; their returns alternate in the file.
TEST(TrajectoryReconstruction, SeparatesChannelsOfOneTime) {
  RayFlight first = wavy(), second = wavy();
  first.trees = second.trees = 1.0;
  second.seed = 2;
  second.from += 1e-9;
  const Points a = first.points();
  RayFlight shifted = second;
  shifted.half_angle = -20.0;  // the other way
  const Points b = shifted.points();
  Points both;
  for (std::size_t i = 0; i + 1 < a.size(); i += 2) {
    for (std::size_t k = i; k < i + 2; ++k) {
      both.push_back(a[k]);
      both.push_back(b[k]);
      both.back().time = a[k].time;
    }
  }
  const ReconstructedPath path = pathOf(both);
  ASSERT_TRUE(path.found);
  EXPECT_TRUE(isWarnedOf(path.warnings, "share a time")) << "ambiguous pulses are reported";
  EXPECT_LT(deviation(path, wavyPath).normalised.maxCoeff(), 2.0);
}

TEST(TrajectoryReconstruction, PairsReturnsWithoutNumbersByTime) {
  Points points = wavy().points();
  for (LidarReturn& point : points) point.return_number = point.number_of_returns = 1;
  const ReconstructedPath path = pathOf(points);
  ASSERT_TRUE(path.found);
  EXPECT_TRUE(isWarnedOf(path.warnings, "have no numbers"));
  EXPECT_LT(deviation(path, wavyPath).normalised.maxCoeff(), 2.0);
}

TEST(TrajectoryReconstruction, CountsDuplicatesAndPointsWithoutTime) {
  Points points;
  for (const LidarReturn& point : wavy().points()) {
    points.push_back(point);
    points.push_back(point);
    LidarReturn& timeless = points.emplace_back(point);
    timeless.time = 0.0;
  }
  const ReconstructedPath path = pathOf(points);
  ASSERT_TRUE(path.found);
  EXPECT_TRUE(isWarnedOf(path.warnings, "repeated points"));
  EXPECT_TRUE(isWarnedOf(path.warnings, "without a time"));
  EXPECT_LT(deviation(path, wavyPath).normalised.maxCoeff(), 2.0);
}

// In a millisecond the sensor moves 6 cm, in a tenth of a second 6 m. Several pulses share a time:
// where some returns are numbered, those that are not belong to different pulses.
TEST(TrajectoryReconstruction, AcceptsRoundedTimes) {
  for (const double step : {1e-3, 0.1}) {
    RayFlight flight = wavy();
    flight.noise = 1e-3;
    Points points = flight.points();
    for (LidarReturn& point : points) point.time = step * std::round(point.time / step);
    const ReconstructedPath path = pathOf(points);
    ASSERT_TRUE(path.found) << path.reason;
    EXPECT_FALSE(isWarnedOf(path.warnings, "have no numbers"));
    EXPECT_LT(path.rejected, path.rays / 5);
    EXPECT_LT(deviation(path, wavyPath).normalised.maxCoeff(), 2.0);
    EXPECT_TRUE(step <= 0.01 || std::abs(path.meanStd().y() - 6.0 / std::sqrt(12.0)) < 0.5);
  }
}

TEST(TrajectoryReconstruction, JoinsStripsOfOneTimeAndDividesAtGaps) {
  const Points points = wavy().points();
  std::vector<Points> tiles(2);
  for (const LidarReturn& point : points)
    if (point.time < 8.0 || point.time > 14.0)
      tiles[point.position.x() > 0.0 ? 1 : 0].push_back(point);
  const std::vector<ReconstructedPath> paths = pathsOf(tiles);
  ASSERT_EQ(paths.size(), 2U) << "the gap of six seconds";
  EXPECT_EQ(paths[0].name, "1 + 2");
  EXPECT_LT(paths[0].times.last, 8.1);
  EXPECT_GT(paths[1].times.first, 13.9);
  for (const ReconstructedPath& path : paths) {
    ASSERT_TRUE(path.found);
    EXPECT_LT(deviation(path, wavyPath).normalised.maxCoeff(), 2.0);
  }
}

// Source ids that are no strips: each point has one of its own.
TEST(TrajectoryReconstruction, NamesOfManyJoinedStripsAreShort) {
  std::vector<Points> strips(40);
  std::size_t i = 0;
  for (const LidarReturn& point : wavy().points()) strips[i++ / 7 % 40].push_back(point);
  const std::vector<ReconstructedPath> paths = pathsOf(strips);
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_EQ(paths[0].name, "1 + 2 + 3 + 4 + 36 more");
  EXPECT_TRUE(paths[0].found);
}

TEST(TrajectoryReconstruction, RefusesImpossibleSettings) {
  TrajectoryReconstruction::Settings settings;
  settings.interval = 0.0;
  EXPECT_THROW(TrajectoryReconstruction{settings}, UsageError);
}

}  // namespace
}  // namespace pcl_als
