// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/calendar_date.h>
#include <pcl_als/common/distributions.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/history/calibration_history.h>

#include "simulated_missions.h"

namespace pcl_als {
namespace {

using P = SystemParameter;
using test::calibrationWith;
using test::MissionSimulator;

constexpr double kArcsec = kRadiansPerArcsec;

CalibrationMission missionWith(const std::vector<P>& order, std::initializer_list<double> bias,
                               std::initializer_list<double> std, double correlation = 0.0) {
  const auto n = static_cast<Eigen::Index>(order.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Constant(n, n, correlation);
  matrix.diagonal().setOnes();
  return missionOf(calibrationWith(order, Eigen::Map<const Eigen::VectorXd>(bias.begin(), n),
                                   Eigen::Map<const Eigen::VectorXd>(std.begin(), n), matrix),
                   "c.json");
}

HistoryOptions noChange() {
  HistoryOptions options;
  options.change_std.setZero();
  return options;
}

TEST(CalibrationHistory, OneParameterIsTheWeightedMean) {
  // 10 +- 1 and 13 +- 2 arcsec: weights 1 and 1/4, mean 10.6, standard deviation sqrt(0.8).
  const CalibrationHistory history =
      calibrationHistory({missionWith({P::boresight_roll}, {10.0 * kArcsec}, {1.0 * kArcsec}),
                          missionWith({P::boresight_roll}, {13.0 * kArcsec}, {2.0 * kArcsec})},
                         noChange());
  const int roll = indexOf(P::boresight_roll);
  EXPECT_NEAR(history.value[roll] / kArcsec, 10.6, 1e-6);
  EXPECT_NEAR(std::sqrt(history.covariance(roll, roll)) / kArcsec, std::sqrt(0.8), 1e-6);
  // (0.6 / 1)^2 + (2.4 / 2)^2 = 1.8 with one degree of freedom.
  EXPECT_NEAR(history[P::boresight_roll].chi_squared, 1.8, 1e-9);
  EXPECT_NEAR(history[P::boresight_roll].p_value, chiSquaredTail(1.8, 1.0), 1e-12);
  EXPECT_TRUE(history[P::boresight_roll].constant);
  EXPECT_FALSE(history.knows(P::range_bias));
}

TEST(CalibrationHistory, CorrelationCarriesKnowledgeToAnotherParameter) {
  // Mission 1: x = 0 +- 1, y = 0 +- 1 cm, correlation 0.8. Mission 2 finds y = 1.0 +- 0.1 cm alone.
  // Hand computation: y = 1 / 1.01, x = 0.8 y, var x = 1 - 0.64 / 1.01.
  const CalibrationHistory history = calibrationHistory(
      {missionWith({P::lever_arm_x, P::lever_arm_y}, {0.0, 0.0}, {0.01, 0.01}, 0.8),
       missionWith({P::lever_arm_y}, {0.01}, {0.001})},
      noChange());
  EXPECT_NEAR(history.value[0], 0.8 * 0.01 / 1.01, 1e-8);
  EXPECT_NEAR(history.value[1], 0.01 / 1.01, 1e-8);
  EXPECT_NEAR(history.covariance(0, 0), 1e-4 * (1.0 - 0.64 / 1.01), 1e-10);
}

TEST(CalibrationHistory, AKnownChangeWidensEveryMission) {
  HistoryOptions options = noChange();
  options.change_std[indexOf(P::boresight_roll)] = 2.0 * kArcsec;
  // Variances 1 + 4 and 4 + 4: mean (10 / 5 + 13 / 8) / (1 / 5 + 1 / 8).
  const CalibrationHistory history =
      calibrationHistory({missionWith({P::boresight_roll}, {10.0 * kArcsec}, {1.0 * kArcsec}),
                          missionWith({P::boresight_roll}, {13.0 * kArcsec}, {2.0 * kArcsec})},
                         options);
  const int roll = indexOf(P::boresight_roll);
  EXPECT_NEAR(history.value[roll] / kArcsec, (10.0 / 5 + 13.0 / 8) / (1.0 / 5 + 1.0 / 8), 1e-6);
  EXPECT_NEAR(history.covariance(roll, roll) / (kArcsec * kArcsec), 1.0 / (1.0 / 5 + 1.0 / 8),
              1e-6);
}

TEST(CalibrationHistory, MissionsAreInOrderOfTheirDates) {
  CalibrationMission late = missionWith({P::range_bias}, {0.02}, {0.01});
  CalibrationMission early = missionWith({P::range_bias}, {0.01}, {0.01});
  late.day = 17000;
  early.day = 16990;
  const CalibrationHistory history = calibrationHistory({late, early});
  EXPECT_TRUE(history.dated);
  EXPECT_EQ(history.missions.front().day, 16990);
  EXPECT_EQ(history.label(1), dateText(17000));
  EXPECT_EQ(dateText(0), "1980-01-06");
  EXPECT_EQ(dateText(16920), "2026-05-04");
}

TEST(CalibrationHistory, OneMissionIsItsOwnHistory) {
  MissionSimulator simulator(5);
  const CalibrationResult only = simulator.calibration(Eigen::VectorXd::Zero(7));
  const CalibrationHistory history = calibrationHistory({missionOf(only, "c.json")});
  for (const P p : MissionSimulator::order()) {
    const int i = indexOf(p);
    EXPECT_NEAR(history.value[i], only[p].bias, 1e-6 * only[p].std);
    EXPECT_NEAR(std::sqrt(history.covariance(i, i)), only[p].std, 1e-6 * only[p].std);
  }
  EXPECT_TRUE(history.changes.empty());
  EXPECT_EQ(history.agreement[0].freedom, 0.0);
  const CalibrationResult pooled = pooledInstrument(history, only);
  EXPECT_LT((pooled.correlation - only.correlation).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(pooled[P::lever_arm_z].status, ParameterStatus::not_estimable);
  EXPECT_TRUE(pooled.verdict.usable());
}

TEST(CalibrationHistory, APriorIsNotCountedAgain) {
  // A calibration of lever arm and pitch with a prior: its information is taken out exactly.
  const std::vector<P> order = {P::lever_arm_y, P::boresight_pitch};
  Eigen::Matrix2d flight, prior;
  flight << 4e-4, 3e-8, 3e-8, 1e-11;  // m^2, m rad, rad^2
  prior << 1e-4, -2e-8, -2e-8, 9e-12;
  const Eigen::Vector2d by_flight(0.02, 3e-5), by_prior(0.05, 2e-5);
  const Eigen::Matrix2d both = flight.inverse() + prior.inverse();
  const Eigen::Vector2d posterior =
      both.inverse() * (flight.inverse() * by_flight + prior.inverse() * by_prior);
  const Eigen::Matrix2d covariance = both.inverse();
  const Eigen::Vector2d std = covariance.diagonal().cwiseSqrt();
  CalibrationResult result = calibrationWith(
      order, posterior, std,
      std.cwiseInverse().asDiagonal() * covariance * std.cwiseInverse().asDiagonal());
  SystemVector mean = SystemVector::Zero();
  mean[1] = by_prior[0];
  mean[3] = by_prior[1];
  result.prior = biasPrior(order, mean, prior);
  const CalibrationMission mission = missionOf(result, "c.json");
  const Eigen::Matrix2d expected = flight.inverse();
  const std::vector<int> rows = {1, 3};
  EXPECT_LT((mission.information(rows, rows) - expected).norm(), 1e-6 * expected.norm());
  EXPECT_NEAR(mission.bias[1], by_flight[0], 1e-6);
  EXPECT_NEAR(mission.std[1], std::sqrt(flight(0, 0)), 1e-6);
  EXPECT_NEAR(mission.bias[3], by_flight[1], 1e-9);
  // A flight that adds nothing to its prior determines nothing.
  result.prior = biasPrior(order, mean, covariance);
  const CalibrationMission empty = missionOf(result, "c.json");
  EXPECT_FALSE(empty.determines(P::lever_arm_y));
  EXPECT_LT(empty.information.norm(), 1e-3 * expected.norm());
}

/// A calibration of the pitch with the lever arm held: effect -2e-3 rad/m, size 0.05 m.
CalibrationMission pitchWithHeldLeverArm(double bias, double conditional_std) {
  constexpr double kEffect = -2e-3, kSize = 0.05;
  CalibrationResult result =
      calibrationWith({P::boresight_pitch}, Eigen::VectorXd::Constant(1, bias),
                      Eigen::VectorXd::Constant(1, std::hypot(conditional_std, kEffect * kSize)),
                      Eigen::MatrixXd::Identity(1, 1));
  result.held_parameters = {{P::lever_arm_y}, {kSize}, Eigen::MatrixXd::Constant(1, 1, kEffect)};
  return missionOf(result, "c.json");
}

TEST(CalibrationHistory, AHeldParameterDoesNotAverageOut) {
  // Two flights over the same kind of block: the lever arm that neither determines is the same.
  const CalibrationHistory history = calibrationHistory(
      {pitchWithHeldLeverArm(1e-5, 4e-6), pitchWithHeldLeverArm(1.2e-5, 4e-6)}, noChange());
  EXPECT_NEAR(history.value[3], 1.1e-5, 1e-9);
  EXPECT_NEAR(std::sqrt(history.covariance(3, 3)), std::hypot(4e-6 / std::sqrt(2.0), 1e-4), 1e-8);
  EXPECT_FALSE(history.knows(P::lever_arm_y));
  EXPECT_EQ(history.covariance(1, 1), 0.0);
}

TEST(CalibrationHistory, KnowledgeOfAHeldParameterCorrectsTheEstimates) {
  // Another flight finds a lever arm of 30 mm: held at zero, it changed the pitch by
  // -2e-3 rad/m * 0.03 m = -6e-5 rad, which the combination puts right.
  const CalibrationHistory history = calibrationHistory(
      {pitchWithHeldLeverArm(1e-5, 4e-6), missionWith({P::lever_arm_y}, {0.03}, {0.001})},
      noChange());
  // b = beta - F h with h = 0.03: beta = 1e-5 + (-2e-3) 0.03.
  EXPECT_NEAR(history.value[3], 1e-5 - 6e-5, 1e-8);
  EXPECT_NEAR(std::sqrt(history.covariance(3, 3)), std::hypot(4e-6, 2e-6), 1e-8);
}

TEST(CalibrationHistory, PooledValuesAreWithinTheirIntervals) {
  // 60 histories of 12 constant missions: 420 values, of which the 95 % intervals contain 90 to
  // 99 % (binomial limits of a probability below 1e-4 on either side).
  int within = 0, values = 0, steps = 0, constant = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    MissionSimulator simulator(1000 + seed);
    const Eigen::VectorXd truth = MissionSimulator::typicalStd().unaryExpr(
        [&](double std) { return 20.0 * std * simulator.normal(); });
    std::vector<CalibrationMission> missions;
    for (int m = 0; m < 12; ++m)
      missions.push_back(missionOf(simulator.calibration(truth), "c.json"));
    const CalibrationHistory history = calibrationHistory(missions);
    bool changed = false, all_constant = true;
    for (const ParameterChange& change : history.changes)
      changed = changed || change.kind == ChangeKind::step;
    steps += changed;
    for (std::size_t i = 0; i < MissionSimulator::order().size(); ++i) {
      const int p = indexOf(MissionSimulator::order()[i]);
      const double error = history.value[p] - truth[static_cast<Eigen::Index>(i)];
      within += std::abs(error) < 1.96 * std::sqrt(history.covariance(p, p));
      ++values;
      all_constant = all_constant && history.parameters[static_cast<std::size_t>(p)].constant;
    }
    constant += all_constant;
  }
  EXPECT_GE(within, 0.90 * values);
  EXPECT_LE(within, 0.99 * values);
  // At a level of 5 %, more than 8 of 60 have a probability of 0.3 %.
  EXPECT_LE(steps, 8);
  EXPECT_GE(constant, 52);
  RecordProperty("within", within);
  RecordProperty("false_steps", steps);
}

TEST(CalibrationHistory, WrongInputIsRefused) {
  EXPECT_THROW(calibrationHistory({}), UsageError);
  HistoryOptions options;
  options.level = 0.7;
  const CalibrationMission mission = missionWith({P::range_bias}, {0.01}, {0.01});
  EXPECT_THROW(calibrationHistory({mission}, options), UsageError);
  options = noChange();
  options.change_std[0] = -1.0;
  EXPECT_THROW(calibrationHistory({mission}, options), UsageError);
  EXPECT_THROW(missionWith({P::range_bias}, {0.01}, {0.0}), InputError);
  EXPECT_THROW(missionWith({P::range_bias, P::lever_arm_x}, {0.01, 0.0}, {0.1, 0.1}, 1.5),
               InputError);
  EXPECT_THROW(missionOf(CalibrationResult(), "c.json"), InputError);
}

}  // namespace
}  // namespace pcl_als
