// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The stages of a calibration with blocks made by hand: what each of them says of given points.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "area_matcher.h"
#include "block.h"
#include "block_calibration.h"
#include "block_solution.h"
#include "pair_set.h"

namespace pcl_als {
namespace {

using P = SystemParameter;

constexpr double kHeight = 500.0;  // metres above ground
constexpr double kSpeed = 50.0;    // metres per second
constexpr double kHalfSwath = 80.0;
constexpr double kLength = 200.0;

/// Strips along north above x = 0 that follow each other in time, every second one to the south.
struct HandMadeBlock {
  std::shared_ptr<const Trajectory> trajectory;
  std::vector<std::vector<LidarReturn>> strips;
};

double startOf(std::size_t strip) {
  return 100.0 * static_cast<double>(strip);
}

std::shared_ptr<const Trajectory> flightOf(std::size_t strips) {
  std::vector<TrajectorySample> samples;
  for (std::size_t strip = 0; strip < strips; ++strip) {
    const bool south = strip % 2 == 1;
    for (double t = -2.0; t <= kLength / kSpeed + 2.0; t += 0.02) {
      TrajectorySample sample;
      sample.time = startOf(strip) + t;
      const double along = kSpeed * t;
      sample.position = {0.0, south ? kLength - along : along, kHeight};
      sample.roll = sample.pitch = 0.0;
      sample.heading = south ? M_PI : 0.0;
      samples.push_back(sample);
    }
  }
  Trajectory::Options options;
  options.use_attitude = true;
  return std::make_shared<const Trajectory>(samples, options);
}

/// Points of the plane z = height, a metre apart, in lines across the flight.
std::vector<LidarReturn> pointsOf(std::size_t strip, double height) {
  const bool south = strip % 2 == 1;
  std::vector<LidarReturn> points;
  for (double line = 0.5; line < kLength; line += 1.0) {
    for (int i = 0; i < 160; ++i) {
      LidarReturn point;
      const double along = line + 0.005 * i;  // where the sensor is
      const double x = -kHalfSwath + 0.1 * static_cast<double>(strip) + i;
      point.position = {x, south ? kLength - along : along, height};
      point.time = startOf(strip) + along / kSpeed;
      points.push_back(point);
    }
  }
  return points;
}

HandMadeBlock planes(const std::vector<double>& heights) {
  HandMadeBlock block{flightOf(heights.size()), {}};
  for (std::size_t strip = 0; strip < heights.size(); ++strip)
    block.strips.push_back(pointsOf(strip, heights[strip]));
  return block;
}

BlockIndex indexOf(const HandMadeBlock& given) {
  BlockIndex index(given.trajectory, Eigen::Vector2d(-kHalfSwath, 0.0));
  for (std::size_t strip = 0; strip < given.strips.size(); ++strip)
    index.add(index.addStrip(std::to_string(strip + 1)), given.strips[strip].data(),
              given.strips[strip].size());
  return index;
}

BlockRequest requestOf() {
  BlockRequest request;
  request.settings.threads = 1;
  request.settings.candidates = 2000;
  return request;
}

SurveyBlock chosen(const HandMadeBlock& given, const BlockRequest& request = requestOf()) {
  return chooseAreas(indexOf(given), request);
}

void load(const HandMadeBlock& given, AreaSample& sample) {
  for (std::size_t strip = 0; strip < given.strips.size(); ++strip)
    sample.add(static_cast<int>(strip), given.strips[strip].data(), given.strips[strip].size());
  sample.prepare();
}

std::string refusalOfBlock(const HandMadeBlock& given, const BlockRequest& request) {
  try {
    chosen(given, request);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(BlockIndex, MergesTheStripsOfOtherIndices) {
  const HandMadeBlock given = planes({0.0, 0.1});
  const BlockIndex all = indexOf(given);
  // One index has the points of the first strip, the other those of the second.
  const Eigen::Vector2d anchor(-kHalfSwath, 0.0);
  BlockIndex first(given.trajectory, anchor), second(given.trajectory, anchor);
  for (BlockIndex* index : {&first, &second}) {
    index->addStrip("1");
    index->addStrip("2");
  }
  first.add(0, given.strips[0].data(), given.strips[0].size());
  second.add(1, given.strips[1].data(), given.strips[1].size());
  ByteWriter out;
  second.putStrip(1, out);
  const std::string bytes = out.take();
  ByteReader in(bytes);
  first.getStrip(1, in);
  for (const int strip : {0, 1}) {
    EXPECT_EQ(first.map().pointCount(strip), all.map().pointCount(strip));
    EXPECT_EQ(first.map().startTime(strip), all.map().startTime(strip));
    EXPECT_EQ(first.plausibility().meanHeight(strip), all.plausibility().meanHeight(strip));
  }
  const SurveyBlock merged = chooseAreas(std::move(first), requestOf());
  const SurveyBlock block = chosen(given);
  ASSERT_EQ(merged.areas.size(), block.areas.size());
  for (std::size_t i = 0; i < block.areas.size(); ++i)
    EXPECT_EQ(merged.areas[i].minimum, block.areas[i].minimum);
}

TEST(SurveyBlock, HasThePairsAndAreasThatStripsHaveInCommon) {
  const SurveyBlock block = chosen(planes({0.0, 0.1}));
  ASSERT_EQ(block.pairs.size(), 1U);
  EXPECT_EQ(block.pairs[0], StripPair(0, 1));
  EXPECT_NEAR(block.pair_heights[0].offset, -0.1, 1e-9);  // of the first above the second
  EXPECT_EQ(block.surveyed[0].points, 160U * 200U);
  EXPECT_NEAR(block.surveyed[0].height, kHeight, 1e-6);
  EXPECT_NEAR(block.surveyed[1].height, kHeight - 0.1, 1e-6);
  EXPECT_NEAR(block.flownTimes()[1].first, 100.01, 1e-9);
  EXPECT_EQ(block.pairAreas(), block.areas.size());
  EXPECT_FALSE(block.areas.empty());
  EXPECT_TRUE(block.scanner.isLinear());
  EXPECT_EQ(block.flight.attitude, AttitudeSource::trajectory);
}

TEST(SurveyBlock, HasAnAreaForEveryControlPoint) {
  BlockRequest request = requestOf();
  ControlPoint point;
  point.id = "c";
  point.position = {10.0, 50.0, 0.0};
  request.control = {point};
  const SurveyBlock block = chosen(planes({0.0, 0.1}), request);
  ASSERT_EQ(block.areas.size(), block.pairAreas() + 1);
  EXPECT_TRUE(block.isControl(block.pairAreas()));
  EXPECT_EQ(block.controlOf(block.pairAreas()).id, "c");
  EXPECT_TRUE(block.areas.back().contains(point.position));
}

TEST(SurveyBlock, LeavesOutStripsWithFewPoints) {
  HandMadeBlock given = planes({0.0, 0.1, 0.2});
  given.strips[1].resize(500);
  const SurveyBlock block = chosen(given);
  EXPECT_EQ(block.strips.used, (std::vector<bool>{true, false, true}));
  ASSERT_EQ(block.excluded.size(), 1U);
  EXPECT_EQ(block.excluded[0].strip, "2");
  EXPECT_EQ(block.excluded[0].reason, ExclusionReason::too_few_points);
  ASSERT_EQ(block.pairs.size(), 1U);
  EXPECT_EQ(block.pairs[0], StripPair(0, 2));
  EXPECT_EQ(block.flownTimes()[1], TimeSpan(0.0, 0.0));
}

// The file of a strip once more, under another id: a standard deviation must not fall by that.
TEST(SurveyBlock, ExcludesACopyOfAStrip) {
  HandMadeBlock given = planes({0.0, 0.1});
  given.strips.push_back(given.strips[0]);
  const SurveyBlock block = chosen(given);
  EXPECT_EQ(block.strips.used, (std::vector<bool>{true, true, false}));
  ASSERT_EQ(block.excluded.size(), 1U);
  EXPECT_EQ(block.excluded[0].reason, ExclusionReason::copy);
  ASSERT_EQ(block.warnings.size(), 1U);
  EXPECT_EQ(block.warnings[0].text,
            "strip 3 holds the same points as strip 1 and is excluded: one is a copy of the other");
  // Points beside these, at the same times, are those of another scanner.
  for (LidarReturn& point : given.strips[2]) point.position.x() += 20.0;
  EXPECT_TRUE(chosen(given).excluded.empty());
}

// Two scanners whose strips have ids of their own; the second strip is another pass.
TEST(SurveyBlock, StripsOfOneTimeAreOnePass) {
  HandMadeBlock given = planes({0.0, 0.1});
  given.strips.push_back(given.strips[0]);
  for (LidarReturn& point : given.strips[2]) point.position.x() += 20.0;
  EXPECT_EQ(chosen(given).systems.pass, (std::vector<int>{0, 1, 0}));
}

TEST(SurveyBlock, RefusesWhatCannotBeCompared) {
  const HandMadeBlock given = planes({0.0, 0.1});
  BlockRequest request = requestOf();
  request.pairs = {{"1", "7"}};
  EXPECT_EQ(refusalOfBlock(given, request), "pairs name strip '7', but the strips are 1, 2");
  request.pairs = {{"1", "1"}};
  EXPECT_EQ(refusalOfBlock(given, request), "pairs name strip '1' with itself");
  request.pairs.clear();
  request.settings.fixed = {"1", "2"};
  EXPECT_EQ(refusalOfBlock(given, request),
            "all strips are held fixed: there is nothing to calibrate");
  request.settings.fixed = {"9"};
  EXPECT_EQ(refusalOfBlock(given, request), "there is no strip 9 to be held fixed");
  HandMadeBlock late = given;
  for (LidarReturn& point : late.strips[1]) point.time += 50.0;
  EXPECT_NE(refusalOfBlock(late, requestOf()).find("the trajectory covers"), std::string::npos);
}

TEST(SurveyBlock, GivesFixedStripsASystemWithoutUnknowns) {
  BlockRequest request = requestOf();
  request.settings.fixed = {"2"};
  const SurveyBlock block = chosen(planes({0.0, 0.1, 0.2}), request);
  EXPECT_EQ(block.systems.count, 2);
  EXPECT_EQ(block.systems.of(0), 0);
  EXPECT_EQ(block.systems.of(1), 1);
  ASSERT_EQ(block.systems.held.size(), 1U);
  EXPECT_EQ(block.systems.held[0].offset, request.settings.fixed_sigma);
  EXPECT_EQ(block.strips.corrected(), (std::vector<bool>{true, false, true}));
}

TEST(PairSet, HasTheDistancesBetweenTheStrips) {
  const HandMadeBlock given = planes({0.0, 0.1});
  const SurveyBlock block = chosen(given);
  AreaSample sample(block);
  load(given, sample);
  const PairSet pairs =
      formPairs(sample, {SystemVector::Zero(), {}, ErrorSourceVector::Zero()}, PairRules());
  ASSERT_GT(pairs.count(), 500U);
  for (const AreaObservations& area : pairs.observations) {
    for (const PairObservation& o : area) {
      EXPECT_NEAR(o.misclosure, o.a == 0 ? -0.1 : 0.1, 1e-9);
      EXPECT_NEAR(o.normal.z(), 1.0, 1e-9);
      EXPECT_NEAR(o.height, kHeight, 0.2);
      // n'A of the lever arm and of the range: the height; the same for both strips.
      EXPECT_NEAR(o.row_a[indexOf(P::lever_arm_z)], 1.0, 1e-6);
      EXPECT_NEAR(o.row()[indexOf(P::lever_arm_z)], 0.0, 1e-6);
    }
  }
  // Nothing lies farther apart.
  for (const AreaObservations& area : pairs.far) EXPECT_TRUE(area.empty());
}

TEST(PairSet, KeepsPairsBeyondTheThresholdApart) {
  const HandMadeBlock given = planes({0.0, 0.1});
  const SurveyBlock block = chosen(given);
  AreaSample sample(block);
  load(given, sample);
  PairRules rules;
  rules.threshold = 0.05;
  PairSet pairs = formPairs(sample, {}, rules);
  EXPECT_EQ(pairs.count(), 0U);
  addFarPairs(sample, {}, pairs);
  EXPECT_GT(pairs.count(), 500U);
}

TEST(PairSet, IsThatOfCorrectedPoints) {
  // The strips are of two systems, and the coordinates of the second one are corrected.
  const HandMadeBlock given = planes({0.0, 0.1});
  BlockRequest request = requestOf();
  request.settings.systems = {{"a", {"1"}}, {"b", {"2"}}};
  const SurveyBlock block = chosen(given, request);
  AreaSample sample(block);
  load(given, sample);
  Corrections corrections;
  corrections.differences.assign(2, SystemUnknowns::Zero());
  corrections.differences[1][kSystemUnknownCount - 1] = 0.1;  // its heights are too large
  const PairSet pairs = formPairs(sample, corrections, PairRules());
  ASSERT_GT(pairs.count(), 500U);
  for (const AreaObservations& area : pairs.observations) {
    for (const PairObservation& o : area) {
      // The misclosure contains the effect of what the points were corrected for.
      EXPECT_NEAR(o.misclosure, o.a == 0 ? -0.1 : 0.1, 1e-6);
    }
  }
}

TEST(PairSet, IsOutdatedAfterAMovementOfACentimetre) {
  PairSet pairs;
  pairs.moved = 0.009;
  EXPECT_FALSE(pairs.isOutdated());
  pairs.moved = 0.011;
  EXPECT_TRUE(pairs.isOutdated());
}

TEST(PairSet, NamesTheAreasWhoseObservationsHaveAWeight) {
  PairSet pairs;
  PairObservation height, plan;
  plan.control_error = PairObservation::ControlError::plan;
  pairs.observations = {{height, plan}, {height}, {plan}};
  const std::vector<AreaUse> used = pairs.used({{1.0, 0.0}, {0.0}, {2.0}});
  EXPECT_TRUE(used[0].heights && !used[0].plan);
  EXPECT_TRUE(!used[1].heights && !used[1].plan);
  EXPECT_TRUE(!used[2].heights && used[2].plan);
}

TEST(BlockSolution, EstimatesWhatPlanesInOppositeDirectionsDetermine) {
  // Heights that differ by the same everywhere are errors of the strips. A roll would tilt the
  // planes against each other; nothing shows a displacement in plan.
  const HandMadeBlock given = planes({0.0, 0.02});
  const SurveyBlock block = chosen(given);
  AreaSample sample(block);
  load(given, sample);
  const PairSet pairs = formPairs(sample, {}, PairRules());
  const SharedErrors errors(block.flownTimes(), block.settings().shared_errors,
                            measuredTimes(sample), block.systems);
  BlockSolution solution(errors, 1);
  ChoiceRules rules{block.settings(), false, false, {}};
  adjust(pairs, rules, true, solution);
  const std::vector<P>& estimate = solution.choice.estimate;
  EXPECT_EQ(std::count(estimate.begin(), estimate.end(), P::boresight_roll), 1);
  EXPECT_EQ(std::count(estimate.begin(), estimate.end(), P::lever_arm_x), 0);
  EXPECT_FALSE(solution.choice.reason[indexOf(P::lever_arm_x)].empty());
  const int roll = indexOf(P::boresight_roll);
  EXPECT_LT(std::abs(solution.solution().biases[roll]),
            2.0 * std::sqrt(solution.solution().covariance(roll, roll)));
  weigh(pairs, true, 1, solution);
  EXPECT_EQ(solution.weights.kept(), pairs.count());
  double largest = 0.0;
  for (const AreaObservations& area : pairs.observations)
    for (const PairObservation& o : area)
      largest = std::max(largest, std::abs(solution.adjustment.residual(o, solution.solution())));
  EXPECT_LT(largest, 0.002);
}

TEST(BlockSolution, GivesAnOutlierNoWeight) {
  HandMadeBlock given = planes({0.0, 0.02});
  const SurveyBlock block = chosen(given);
  AreaSample sample(block);
  load(given, sample);
  PairSet pairs = formPairs(sample, {}, PairRules());
  pairs.observations[0][0].misclosure += 1.0;
  const SharedErrors errors(block.flownTimes(), block.settings().shared_errors,
                            measuredTimes(sample), block.systems);
  BlockSolution solution(errors, 1);
  const ChoiceRules rules{block.settings(), false, true, {}};
  adjust(pairs, rules, true, solution);
  weigh(pairs, true, 1, solution);
  EXPECT_EQ(solution.weights.weights()[0][0], 0.0);
  EXPECT_EQ(solution.weights.kept(), pairs.count() - 1);
}

}  // namespace
}  // namespace pcl_als
