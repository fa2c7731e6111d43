// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The roll of a trajectory against the edges of the swath and recorded scan angles. 2026-11: a
// negated roll was accepted where one edge of the swath was that of a scene or a tile.
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

#include "flights.h"

namespace pcl_als {
namespace {

constexpr double kHalfSwath = 0.35;  // radians

/// A flight of 20 s at 1000 m and how its points are recorded.
struct Flight {
  double roll = 0.01;       ///< radians, amplitude
  bool stabilised = false;  ///< the scanner compensates the roll
  /// Metres across the flight line: points beyond are absent.
  double left_end = -1e9, right_end = 1e9;
  enum class Angle { none, from_vertical, in_body } angle = Angle::none;
  double angle_sign = 1.0;  ///< of recorded angles
};

/// Findings when the attitude is changed by \a change before it is given.
std::string saidOfRoll(const Flight& flight, const std::function<void(TrajectorySample&)>& change) {
  auto samples = test::sampled(test::straight(0.0), 0.0, 20.0, 0.005);
  std::vector<TrajectorySample> given = samples;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].roll = flight.roll * std::sin(1.1 * samples[i].time);
    samples[i].pitch = samples[i].heading = 0.0;
    given[i] = samples[i];
    change(given[i]);
  }
  Trajectory::Options options;
  options.use_attitude = true;
  TrajectoryPlausibility check(std::make_shared<const Trajectory>(given, options));
  check.addStrip("1");
  for (const TrajectorySample& sample : samples) {
    for (int i = -10; i <= 10; ++i) {
      const double mirror = kHalfSwath * i / 10.0;  // to the right
      // Right wing down turns the pulse to the left.
      const double look = flight.stabilised ? mirror : mirror - sample.roll;
      const double across = 1000.0 * std::tan(look);
      if (across < flight.left_end || across > flight.right_end) continue;
      const Eigen::Vector3d point = sample.position + Eigen::Vector3d(across, 0.0, -1000.0);
      double angle = std::numeric_limits<double>::quiet_NaN();
      if (flight.angle != Flight::Angle::none) {
        const double exact = flight.angle == Flight::Angle::in_body ? look + sample.roll : look;
        angle = flight.angle_sign * std::round(exact / kRadiansPerDegree);
      }
      check.add(0, sample.time, point, angle);
    }
  }
  const auto findings = check.findings();
  return findings.empty()
             ? ""
             : (findings[0].refuse ? "refused: " : "warning: ") + findings[0].warning.text;
}

void negate(TrajectorySample& sample) {
  sample.roll = -sample.roll;
}
void keep(TrajectorySample&) {}

bool refusedSign(const std::string& text) {
  return text.rfind("refused: the roll of the trajectory has the opposite sign", 0) == 0;
}

TEST(RollSign, ShowsAtTheEdgesOfTheSwath) {
  const Flight flight;
  EXPECT_EQ(saidOfRoll(flight, keep), "");
  EXPECT_TRUE(refusedSign(saidOfRoll(flight, negate)));
  // A twentieth of a degree is enough where the swath is sampled well.
  Flight calm;
  calm.roll = 0.05 * kRadiansPerDegree;
  EXPECT_EQ(saidOfRoll(calm, keep), "");
  EXPECT_TRUE(refusedSign(saidOfRoll(calm, negate)));
}

TEST(RollSign, OneEdgeOfAScene) {
  Flight flight;
  flight.right_end = 200.0;
  EXPECT_EQ(saidOfRoll(flight, keep), "");
  EXPECT_TRUE(refusedSign(saidOfRoll(flight, negate)));
}

TEST(RollSign, RadiansAndColumnsWithoutValues) {
  const Flight flight;
  const std::string radians = saidOfRoll(flight, [](auto& s) { s.roll *= kRadiansPerDegree; });
  EXPECT_EQ(radians.rfind("refused: the roll of the trajectory changes by a 57th", 0), 0)
      << radians;
  const std::string zeros = saidOfRoll(flight, [](auto& s) { s.roll = 0.0; });
  EXPECT_EQ(zeros.rfind("refused: the roll of the trajectory is the same at all times", 0), 0)
      << zeros;
}

// What cannot be known is not objected to.
TEST(RollSign, NothingIsSaidWithoutEvidence) {
  Flight still;
  still.roll = 0.001 * kRadiansPerDegree;
  EXPECT_EQ(saidOfRoll(still, negate), "") << "no changes of roll";
  Flight stabilised;
  stabilised.stabilised = true;
  EXPECT_EQ(saidOfRoll(stabilised, negate), "") << "the swath does not follow the roll";
  stabilised.angle = Flight::Angle::from_vertical;
  EXPECT_EQ(saidOfRoll(stabilised, negate), "") << "nor do angles from the vertical";
}

// Between two tile borders the edges show nothing; angles of the mirror, in whole degrees, do.
TEST(RollSign, ShowsInRecordedAnglesOfTheMirror) {
  for (const double sign : {1.0, -1.0}) {  // a convention
    Flight tile;
    tile.left_end = -200.0, tile.right_end = 200.0;
    tile.roll = 0.02;
    EXPECT_EQ(saidOfRoll(tile, negate), "") << "without recorded angles";
    tile.angle = Flight::Angle::in_body;
    tile.angle_sign = sign;
    EXPECT_EQ(saidOfRoll(tile, keep), "") << sign;
    EXPECT_TRUE(refusedSign(saidOfRoll(tile, negate))) << sign;
    Flight stabilised = tile;
    stabilised.stabilised = true;
    EXPECT_EQ(saidOfRoll(stabilised, keep), "") << sign;
    EXPECT_TRUE(refusedSign(saidOfRoll(stabilised, negate))) << sign;
  }
}

}  // namespace
}  // namespace pcl_als
