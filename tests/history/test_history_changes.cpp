// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include <pcl_als/common/calendar_date.h>
#include <pcl_als/history/calibration_history.h>

#include "simulated_missions.h"

namespace pcl_als {
namespace {

using P = SystemParameter;
using test::MissionSimulator;

constexpr std::size_t kRoll = 3;  // in the order of MissionSimulator
constexpr int kMissions = 12;

/// A history of 12 missions, 30 days apart, with an effect on the truth of each.
CalibrationHistory historyWith(
    unsigned seed, const std::function<void(int, MissionSimulator&, Eigen::VectorXd&)>& effect) {
  MissionSimulator simulator(seed);
  std::vector<CalibrationMission> missions;
  for (int m = 0; m < kMissions; ++m) {
    Eigen::VectorXd truth = Eigen::VectorXd::Zero(7);
    effect(m, simulator, truth);
    missions.push_back(missionOf(simulator.calibration(truth), "m" + std::to_string(m)));
    missions.back().day = 16000 + 30 * m;
    missions.back().covariates["temperature"] = 20.0 + 8.0 * std::sin(2.0 * m);
  }
  return calibrationHistory(missions);
}

const ParameterChange* changeOf(const CalibrationHistory& history, P parameter, ChangeKind kind) {
  for (const ParameterChange& change : history.changes)
    if (change.parameter == parameter && change.kind == kind) return &change;
  return nullptr;
}

TEST(HistoryChanges, AStepOfThreeStandardDeviationsIsFound) {
  // 60 histories with a step in one random parameter, of three standard deviations of a
  // calibration, after three to nine of twelve missions.
  int found = 0, within_one = 0, others = 0, covered = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    MissionSimulator choice(7000 + seed);
    const auto which = static_cast<Eigen::Index>(choice.uniform(0.0, 7.0));
    const int first = 3 + static_cast<int>(choice.uniform(0.0, 7.0));
    const double size = 3.0 * MissionSimulator::typicalStd()[which];
    const CalibrationHistory history =
        historyWith(2000 + seed, [&](int m, MissionSimulator&, Eigen::VectorXd& truth) {
          if (m >= first) truth[which] += size;
        });
    const P parameter = MissionSimulator::order()[static_cast<std::size_t>(which)];
    const ParameterChange* step = changeOf(history, parameter, ChangeKind::step);
    for (const ParameterChange& change : history.changes) others += change.parameter != parameter;
    if (step == nullptr) continue;
    ++found;
    within_one += std::abs(static_cast<int>(step->first_after) - first) <= 1;
    covered += std::abs(step->size - size) < 3.0 * step->std;
  }
  RecordProperty("found", found);
  RecordProperty("within_one", within_one);
  EXPECT_GE(found, 54);
  EXPECT_GE(within_one, found - 5);
  EXPECT_LE(others, 8);
  EXPECT_GE(covered, found - 2);
}

TEST(HistoryChanges, ASmallerStepThanTheNoiseIsNotInvented) {
  int changes = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const CalibrationHistory history =
        historyWith(3000 + seed, [](int, MissionSimulator&, Eigen::VectorXd&) {});
    changes += !history.changes.empty();
  }
  // At a level of 5 %, more than 11 of 100 have a probability of 0.4 %.
  EXPECT_LE(changes, 11);
}

TEST(HistoryChanges, ADriftIsNoStep) {
  int drifts = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const double slope = 0.05 * kRadiansPerArcsec;  // per day: 16.5 arcsec over the history
    const CalibrationHistory history =
        historyWith(4000 + seed, [&](int m, MissionSimulator&, Eigen::VectorXd& truth) {
          truth[kRoll] += slope * 30.0 * m;
        });
    const ParameterChange* drift = changeOf(history, P::boresight_roll, ChangeKind::drift);
    if (drift == nullptr || drift->covariate != "date") continue;
    ++drifts;
    EXPECT_NEAR(drift->size, slope, 4.0 * drift->std);
    // The value from now on is that at the last mission.
    const int roll = indexOf(P::boresight_roll);
    EXPECT_NEAR(history.value[roll], slope * 330.0,
                4.0 * std::sqrt(history.covariance(roll, roll)));
  }
  EXPECT_GE(drifts, 18);
}

TEST(HistoryChanges, ADependenceOnTheTemperatureIsNamed) {
  int found = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const CalibrationHistory history =
        historyWith(5000 + seed, [](int m, MissionSimulator&, Eigen::VectorXd& truth) {
          truth[kRoll] += 0.8 * kRadiansPerArcsec * 8.0 * std::sin(2.0 * m);
        });
    const ParameterChange* drift = changeOf(history, P::boresight_roll, ChangeKind::drift);
    found += drift != nullptr && drift->covariate == "temperature" &&
             std::abs(drift->size - 0.8 * kRadiansPerArcsec) < 4.0 * drift->std;
  }
  EXPECT_GE(found, 18);
}

TEST(HistoryChanges, OneWrongMissionIsAnOutlierAndLeavesTheValueAlone) {
  int found = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const CalibrationHistory history =
        historyWith(6000 + seed, [](int m, MissionSimulator&, Eigen::VectorXd& truth) {
          if (m == 5) truth[kRoll] += 20.0 * kRadiansPerArcsec;
        });
    const ParameterChange* outlier = changeOf(history, P::boresight_roll, ChangeKind::outlier);
    if (outlier == nullptr) continue;
    ++found;
    EXPECT_EQ(outlier->first_after, 5U);
    EXPECT_FALSE(history.agreement[5].agrees);
    const int roll = indexOf(P::boresight_roll);
    EXPECT_LT(std::abs(history.value[roll]), 4.0 * std::sqrt(history.covariance(roll, roll)));
  }
  EXPECT_EQ(found, 20);
}

TEST(HistoryChanges, RandomVariationIsAVarianceAndNotAStep) {
  // Roll varies by 6 arcsec from flight to flight, four times its standard deviation.
  int steps = 0, within = 0;
  double mean = 0.0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const CalibrationHistory history =
        historyWith(8000 + seed, [](int, MissionSimulator& simulator, Eigen::VectorXd& truth) {
          truth[kRoll] += 6.0 * kRadiansPerArcsec * simulator.normal();
        });
    const int roll = indexOf(P::boresight_roll);
    EXPECT_FALSE(history[P::boresight_roll].constant);
    steps += changeOf(history, P::boresight_roll, ChangeKind::step) != nullptr;
    mean += history[P::boresight_roll].change_std / kRadiansPerArcsec / 40.0;
    within += std::abs(history.value[roll]) < 1.96 * std::sqrt(history.covariance(roll, roll));
  }
  RecordProperty("steps", steps);
  EXPECT_LE(steps, 6);
  EXPECT_NEAR(mean, 6.0, 1.0);
  EXPECT_GE(within, 33);
}

TEST(HistoryChanges, TheSentenceNamesParameterSizeAndMissions) {
  const CalibrationHistory history =
      historyWith(9001, [](int m, MissionSimulator&, Eigen::VectorXd& truth) {
        if (m >= 6) truth[kRoll] += 30.0 * kRadiansPerArcsec;
      });
  ASSERT_EQ(history.changes.size(), 1U);
  const std::string text = changeText(history, history.changes.front());
  EXPECT_NE(text.find("boresight_roll changed by"), std::string::npos) << text;
  EXPECT_NE(text.find("between " + dateText(16150) + " and " + dateText(16180)), std::string::npos)
      << text;
  EXPECT_NE(text.find("p < 0.001"), std::string::npos) << text;
  ASSERT_EQ(history[P::boresight_roll].segments.size(), 2U);
  EXPECT_EQ(history[P::boresight_roll].segments[1].first, 6U);
}

}  // namespace
}  // namespace pcl_als
