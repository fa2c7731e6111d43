// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/calibration/flight_plan.h>
#include <pcl_als/common/errors.h>

#include "observability.h"
#include "synthetic_pairs.h"

namespace pcl_als {
namespace {

using P = SystemParameter;

StripGeometry line(const char* id, Eigen::Vector2d start, Eigen::Vector2d end, double height) {
  StripGeometry strip;
  strip.id = id;
  strip.start = start;
  strip.end = end;
  strip.height = height;
  return strip;
}

/// There and back at 1000 m, over the same ground.
std::vector<StripGeometry> oneHeight() {
  return {line("1", {0, 0}, {0, 1500}, 1000.0), line("2", {0, 1500}, {0, 0}, 1000.0)};
}

FlightPlan::Settings settings(double ground_slope, double steep_share, std::size_t control) {
  FlightPlan::Settings settings;
  settings.surface.ground_slope = ground_slope * kRadiansPerDegree;
  settings.surface.steep_share = steep_share;
  settings.control_points = control;
  return settings;
}

const WeakCombination* weakWith(const ObservabilityReport& report, P p) {
  for (const WeakCombination& weak : report.weak) {
    for (const P named : weak.parameters) {
      if (named == p) return &weak;
    }
  }
  return nullptr;
}

double stdOf(const FlightPlanResult& result, P p) {
  return result.expected[p].std;
}

TEST(FlightPlan, OneHeightOverFlatGroundConfusesPitchWithTheLeverArm) {
  for (const double steep : {0.0, 0.02}) {  // a plane, and a plane with some roofs
    const FlightPlanResult result = FlightPlan(oneHeight(), settings(0.0, steep, 3)).evaluate();
    EXPECT_EQ(result.expected[P::lever_arm_y].status, ParameterStatus::not_estimable);
    const WeakCombination* weak = weakWith(result.observability, P::lever_arm_y);
    ASSERT_NE(weak, nullptr);
    EXPECT_NE(weak->text.find("lever_arm_y"), std::string::npos) << weak->text;
    EXPECT_NE(weak->text.find("boresight_pitch"), std::string::npos) << weak->text;
    EXPECT_NE(weak->cause.find("single flying height (1000 m)"), std::string::npos) << weak->text;
    EXPECT_EQ(weak->cause.find("hardly any slopes") != std::string::npos, steep == 0.0);
  }
}

TEST(FlightPlan, WithoutControlThereIsNoRangeBias) {
  const FlightPlanResult without = FlightPlan(oneHeight(), settings(5.0, 0.05, 0)).evaluate();
  EXPECT_EQ(without.expected[P::range_bias].status, ParameterStatus::not_estimable);
  const WeakCombination* weak = weakWith(without.observability, P::range_bias);
  ASSERT_NE(weak, nullptr);
  EXPECT_NE(weak->cause.find("no control"), std::string::npos) << weak->text;
  const FlightPlanResult with = FlightPlan(oneHeight(), settings(5.0, 0.05, 9)).evaluate();
  EXPECT_EQ(with.expected[P::range_bias].status, ParameterStatus::estimated);
}

TEST(FlightPlan, OneDirectionCancelsWhatItCannotSee) {
  const std::vector<StripGeometry> lines{line("a", {0, 0}, {0, 1500}, 1000.0),
                                         line("b", {50, 0}, {50, 1500}, 1000.0)};
  const FlightPlanResult result = FlightPlan(lines, settings(5.0, 0.05, 0)).evaluate();
  for (const P p : {P::lever_arm_x, P::lever_arm_y, P::boresight_pitch}) {
    EXPECT_EQ(result.expected[p].status, ParameterStatus::not_estimable) << infoOf(p).name;
  }
  const WeakCombination* weak = weakWith(result.observability, P::boresight_pitch);
  ASSERT_NE(weak, nullptr);
  EXPECT_NE(weak->cause.find("one flight direction"), std::string::npos) << weak->text;
  ASSERT_FALSE(result.observability.advice.empty());
  ASSERT_NE(result.observability.cheapestLine(), nullptr);
}

/// What the advice says of a line is what the plan with that line says.
TEST(FlightPlan, AnAddedLineKeepsWhatTheAdviceSaid) {
  FlightPlan::Settings with = settings(5.0, 0.1, 9);
  with.estimate = {P::boresight_pitch, P::lever_arm_x, P::lever_arm_y, P::boresight_roll,
                   P::boresight_heading};
  const FlightPlanResult before = FlightPlan(oneHeight(), with).evaluate();
  const Advice* second = nullptr;
  for (const Advice& advice : before.observability.advice) {
    if (advice.what.find("opposite line at a second height, 500 m") != std::string::npos) {
      second = &advice;
    }
  }
  ASSERT_NE(second, nullptr);
  std::vector<StripGeometry> lines = oneHeight();
  lines.push_back(second->line);
  const FlightPlanResult after = FlightPlan(lines, with).evaluate();
  for (const P p : {P::boresight_pitch, P::lever_arm_y}) {
    const int i = indexOf(p);
    EXPECT_LT(second->after[i], 0.7 * second->before[i]) << infoOf(p).name;
    // Other areas are chosen when the line is planned from the start.
    EXPECT_NEAR(stdOf(after, p) / second->after[i], 1.0, 0.15) << infoOf(p).name;
  }
  for (std::size_t i = 1; i < before.observability.advice.size(); ++i) {
    EXPECT_GE(before.observability.advice[i - 1].benefit, before.observability.advice[i].benefit);
  }
}

/// Four times the trajectory errors give some four times the uncertainty: nothing averages out.
TEST(FlightPlan, TrajectoryErrorsSetTheScale) {
  FlightPlan::Settings small = settings(5.0, 0.1, 0), large = small;
  small.estimate = large.estimate = {P::boresight_roll, P::boresight_pitch};
  large.shared_errors.roll_pitch *= 4.0;
  large.shared_errors.position *= 4.0;
  large.shared_errors.heading *= 4.0;
  const double ratio = stdOf(FlightPlan(oneHeight(), large).evaluate(), P::boresight_roll) /
                       stdOf(FlightPlan(oneHeight(), small).evaluate(), P::boresight_roll);
  EXPECT_GT(ratio, 3.0);
  EXPECT_LT(ratio, 4.2);
}

TEST(FlightPlan, RefusesWhatCannotBeFlown) {
  const FlightPlan::Settings plain;
  EXPECT_THROW(FlightPlan({}, plain), UsageError);
  EXPECT_THROW(FlightPlan({line("1", {0, 0}, {0, 0}, 500.0)}, plain), UsageError);
  EXPECT_THROW(FlightPlan({line("1", {0, 0}, {0, 900}, -5.0)}, plain), UsageError);
  EXPECT_THROW(FlightPlan({line("1", {0, 0}, {0, NAN}, 500.0)}, plain), UsageError);
  EXPECT_THROW(
      FlightPlan({line("1", {0, 0}, {0, 900}, 500.0), line("1", {9, 0}, {9, 900}, 500.0)}, plain),
      UsageError);
  EXPECT_THROW(FlightPlan({line("1", {0, 0}, {0, 900}, 500.0)}, plain).evaluate(), InputError);
  EXPECT_THROW(
      FlightPlan({line("1", {0, 0}, {0, 900}, 500.0), line("2", {5000, 0}, {5000, 900}, 500.0)},
                 plain)
          .evaluate(),
      InputError);
}

TEST(Observability, AMatrixThatIsNotFiniteHasNoDirections) {
  // 2026-11: a control sigma of 1e160 m made the matrix infinite, and describing it crashed.
  const SystemMatrix infinite = SystemMatrix::Constant(std::numeric_limits<double>::infinity());
  const Observability unknown(infinite,
                              {SystemParameter::boresight_roll, SystemParameter::range_bias},
                              SystemVector::Ones());
  EXPECT_TRUE(unknown.directions().empty());
}

TEST(Observability, NamesDirectionsInMetresOnTheGround) {
  SystemVector effect = Observability::groundEffect(1000.0, 20.0 * kRadiansPerDegree);
  EXPECT_NEAR(effect[indexOf(P::lever_arm_y)], 1.0, 1e-12);
  EXPECT_NEAR(effect[indexOf(P::boresight_pitch)], 1000.0, 1e-9);
  EXPECT_NEAR(effect[indexOf(P::boresight_heading)], 1000.0 * std::tan(20.0 * kRadiansPerDegree),
              1e-9);
  // Only the sum of both effects was measured, to 5 mm; what keeps their sum is unknown.
  SystemVector row = SystemVector::Zero();
  row[indexOf(P::lever_arm_y)] = effect[indexOf(P::lever_arm_y)];
  row[indexOf(P::boresight_pitch)] = effect[indexOf(P::boresight_pitch)];
  Observability observability(row * row.transpose() / (0.005 * 0.005),
                              {P::lever_arm_y, P::boresight_pitch}, effect);
  const auto directions = observability.directions();
  ASSERT_EQ(directions.size(), 2U);
  EXPECT_TRUE(std::isinf(directions[0].std));
  EXPECT_NE(directions[0].text.find("together, not observed apart from each other"),
            std::string::npos)
      << directions[0].text;
  EXPECT_NEAR(directions[1].std, 0.005 / std::sqrt(2.0), 1e-9);
  EXPECT_NE(directions[1].text.find(" m and "), std::string::npos) << directions[1].text;
  EXPECT_NE(directions[1].text.find("each up to 2.5 mm on the ground"), std::string::npos);
  SystemVector twice = SystemVector::Constant(2.0);
  observability.weaken(twice);
  EXPECT_NEAR(observability.directions()[1].std, 0.01 / std::sqrt(2.0), 1e-9);
}

/// At most two directions, none below what the errors of the trajectory cause anyway.
TEST(Observability, TextHoldsTheWeakestDirections) {
  ObservabilityReport report;
  report.other_errors = 0.03;
  for (const double std : {0.2, 0.1, 0.05, 0.02}) {
    report.directions.emplace_back();
    report.directions.back().std = std;
    report.directions.back().text = std::to_string(std);
  }
  const auto told = [&report] {
    const std::vector<std::string> lines = report.text();
    return std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
      return line.find("weakly determined: ") == 0;
    });
  };
  EXPECT_EQ(told(), 2);
  report.other_errors = 0.15;
  EXPECT_EQ(told(), 1);
}

TEST(FlightPlan, AThirdHeightIsNoSecondOne) {
  std::vector<StripGeometry> lines = oneHeight();
  lines.push_back(line("3", {0, 0}, {0, 1500}, 2000.0));
  const FlightPlanResult result = FlightPlan(lines, settings(5.0, 0.1, 9)).evaluate();
  bool another = false;
  for (const Advice& advice : result.observability.advice) {
    EXPECT_EQ(advice.what.find("second height"), std::string::npos) << advice.what;
    another = another || advice.what.find("at another height, ") != std::string::npos;
  }
  EXPECT_TRUE(another);
}

TEST(ObservedBlock, ThinnedHoldsTheSameInformation) {
  ObservedBlock block;
  for (int i = 0; i < 5; ++i) SyntheticPairs::addStrip(oneHeight().front(), block);
  SyntheticPairs(SyntheticPairs::Settings()).addPairs(0, block);
  ASSERT_GT(block.observationCount(), 2000U);
  ObservedBlock thin = block;
  thin.observations = thinned(block.observations, block.weights, 1000).observations;
  EXPECT_LT(thin.observationCount(), block.observationCount() / 2);
  const auto sum = [](const std::vector<std::vector<double>>& weights) {
    double all = 0.0;
    for (const auto& area : weights) {
      for (const double weight : area) all += weight;
    }
    return all;
  };
  EXPECT_NEAR(sum(thinned(block.observations, block.weights, 1000).weights) / sum(block.weights),
              1.0, 0.1);
}

}  // namespace
}  // namespace pcl_als
