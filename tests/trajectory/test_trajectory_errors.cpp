// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/bias_evaluator.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "flights.h"

namespace pcl_als {
namespace {

using test::sampled;
using test::straight;

TrajectoryErrorKnot knot(double time, double up, double roll) {
  return {time, {0.0, 0.0, up}, {0.0, roll, 0.0}};
}

std::vector<StripErrors> twoStrips() {
  return {{"b", {knot(20.0, 0.05, 0.0), knot(30.0, 0.05, 0.0)}, {}},
          {"a", {knot(0.0, 0.0, 0.0), knot(5.0, 0.10, 1e-4), knot(10.0, 0.0, 0.0)}, {}}};
}

TEST(TrajectoryErrors, AreLinearBetweenKnotsAndZeroAwayFromStrips) {
  const TrajectoryErrors errors(twoStrips());
  const struct {
    double time, up;
    bool covered;
  } rows[] = {{2.5, 0.05, true},  {5.0, 0.10, true},  {9.0, 0.02, true},
              {11.9, 0.0, true},  {15.0, 0.0, false}, {18.5, 0.05, true},
              {31.9, 0.05, true}, {32.1, 0.0, false}, {-2.1, 0.0, false}};
  for (const auto& row : rows) {
    TrajectoryErrorKnot found;
    EXPECT_EQ(errors.at(row.time, found), row.covered) << row.time;
    EXPECT_NEAR(found.position.z(), row.up, 1e-12) << row.time;
  }
  TrajectoryErrorKnot found;
  ASSERT_TRUE(errors.at(2.5, found));
  EXPECT_NEAR(found.angles.y(), 5e-5, 1e-15);
}

TEST(TrajectoryErrors, BetweenCloseStripsTheNearerCounts) {
  const TrajectoryErrors errors(
      {{"a", {knot(0.0, 0.1, 0.0), knot(10.0, 0.1, 0.0)}, {}}, {"b", {knot(12.0, 0.3, 0.0)}, {}}});
  TrajectoryErrorKnot found;
  ASSERT_TRUE(errors.at(10.9, found));
  EXPECT_NEAR(found.position.z(), 0.1, 1e-12);
  ASSERT_TRUE(errors.at(11.1, found));
  EXPECT_NEAR(found.position.z(), 0.3, 1e-12);
}

TEST(TrajectoryErrors, OfStripsOfOnePassCountOnce) {
  auto strips = twoStrips();
  strips.push_back(strips[0]);
  strips.back().id = "other scanner";
  const TrajectoryErrors once(twoStrips()), both(strips);
  TrajectoryErrorKnot expected, found;
  for (const double time : {-1.0, 3.0, 25.0}) {
    ASSERT_EQ(both.at(time, found), once.at(time, expected));
    EXPECT_EQ(found.position, expected.position);
  }
}

TEST(TrajectoryErrors, RefusesWhatIsNoFunctionOfTime) {
  auto strips = twoStrips();
  strips[0].knots[0].time = 9.0;
  EXPECT_THROW(TrajectoryErrors{strips}, InputError);
  strips = twoStrips();
  std::swap(strips[1].knots[0], strips[1].knots[1]);
  EXPECT_THROW(TrajectoryErrors{strips}, InputError);
  strips = twoStrips();
  strips[1].knots[1].angles.x() = std::nan("");
  EXPECT_THROW(TrajectoryErrors{strips}, InputError);
}

TEST(TrajectoryErrors, AreTakenOutWithTheBiases) {
  const auto trajectory = std::make_shared<Trajectory>(sampled(straight(0), -1.0, 40.0, 0.005));
  const auto errors = std::make_shared<TrajectoryErrors>(twoStrips());
  SystemVector biases = SystemVector::Zero();
  biases[indexOf(SystemParameter::boresight_roll)] = 3e-4;
  const BiasEvaluator evaluator(trajectory, biases, errors);
  std::vector<double> t, x, y, z;
  for (double time = 0.001; time < 39.0; time += 0.0137) {
    t.push_back(time), x.push_back(300.0), y.push_back(60.0 * time), z.push_back(0.0);
  }
  std::vector<double> dx(t.size()), dy(t.size()), dz(t.size());
  CoverageCount coverage;
  evaluator.effect({t.data(), x.data(), y.data(), z.data()}, t.size(),
                   {dx.data(), dy.data(), dz.data()}, coverage);
  for (std::size_t i = 0; i < t.size(); ++i) {
    TrajectoryErrorKnot at;
    errors->at(t[i], at);
    const double roll = 3e-4 + at.angles.y();
    // East z df, up -x df, and the position; second order under 0.1 mm. In a tenth of a second the
    // roll changes by 2e-6: 1 mm at 1000 m from its middle.
    EXPECT_NEAR(dx[i], -1000.0 * roll, 1.2e-3) << t[i];
    const bool at_an_end =
        std::abs(t[i] - 12.0) < 0.1 || std::abs(t[i] - 18.0) < 0.1 || std::abs(t[i] - 32.0) < 0.1;
    if (at_an_end) continue;
    EXPECT_NEAR(dz[i], -300.0 * roll + at.position.z(), 4e-4) << t[i];
  }
}

}  // namespace
}  // namespace pcl_als
