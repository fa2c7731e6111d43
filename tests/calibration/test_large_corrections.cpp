// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Where the trajectory is wrong by more than ordinary errors: numbers computed by hand, and
// simulated blocks with an error in a known interval.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "correction_causes.h"
#include "correction_excursions.h"
#include "rejected_pairs.h"
#include "simulated_survey.h"

namespace pcl_als {
namespace {

constexpr std::size_t kNorth = 1, kUp = 2, kRoll = 4, kHeading = 5;

/// A strip from 100 s with a knot every second, all errors zero with these standard deviations.
StripErrors quietStrip(const std::string& id, int knots, double std) {
  StripErrors strip{id, {}, {}};
  for (int i = 0; i < knots; ++i) {
    TrajectoryErrorKnot knot;
    knot.time = 100.0 + i;
    knot.position_std.setConstant(std);
    knot.angles_std.setConstant(1e-3 * std);
    strip.knots.push_back(knot);
  }
  return strip;
}

/// The heights of strip 2 rise to 0.27 m at 106 s and return.
std::vector<StripErrors> stripsWithHill() {
  std::vector<StripErrors> strips{quietStrip("1", 21, 0.01), quietStrip("2", 21, 0.01),
                                  quietStrip("3", 21, 0.01)};
  const std::vector<double> hill{0.0, 0.09, 0.18, 0.27, 0.27, 0.18, 0.10, -0.02};
  for (std::size_t i = 0; i < hill.size(); ++i) strips[1].knots[i + 3].position.z() = hill[i];
  return strips;
}

TEST(LargeCorrections, HaveLimitsForAllKnotsTogether) {
  const SharedErrorModel model;
  const OrdinaryErrors ordinary(stripsWithHill(), model);
  // 0.01 / 2 / (63 knots x 6 axes) = 1.323e-5: 4.202 standard deviations of a normal variable.
  EXPECT_NEAR(ordinary.significant(), 4.202, 5e-4);
  EXPECT_DOUBLE_EQ(ordinary.std(kUp), 0.02);  // the block's: 0.01
  EXPECT_NEAR(ordinary.limit(0), 4.202 * 0.02, 1e-4);
  EXPECT_NEAR(ordinary.limit(kHeading), 4.202 * model.heading, 1e-7);
  // Twice as large errors throughout, with 3 (1 + 20 / 5) degrees of freedom: Student's t 5.95.
  std::vector<StripErrors> rough = stripsWithHill();
  for (StripErrors& strip : rough)
    for (std::size_t i = 0; i < strip.knots.size(); ++i)
      strip.knots[i].position.x() = i % 2 == 0 ? 0.04 : -0.04;
  const OrdinaryErrors larger(rough, model);
  const double std = 1.4826 * 0.04;
  EXPECT_NEAR(larger.std(0), std, 1e-5);
  EXPECT_NEAR(larger.limit(0), 5.954 * std, 1e-3 * std);
}

TEST(LargeCorrections, ReachToHalfOfTheirPeak) {
  const std::vector<StripErrors> strips = stripsWithHill();
  const auto found = findExcursions(strips, OrdinaryErrors(strips, SharedErrorModel()));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].curve, CorrectionCurve(1, kUp));
  EXPECT_EQ(found[0].time, 106.0);
  EXPECT_EQ(found[0].value, 0.27);
  EXPECT_EQ(found[0].std, 0.01);
  EXPECT_NEAR(found[0].from, 104.5, 1e-9);               // 0.135 between 0.09 and 0.18
  EXPECT_NEAR(found[0].to, 108.0 + 0.045 / 0.08, 1e-9);  // between 0.18 and 0.10
  EXPECT_NEAR(found[0].ordinary, 0.02, 1e-12);
}

TEST(LargeCorrections, AreSignificant) {
  std::vector<StripErrors> strips = stripsWithHill();
  for (TrajectoryErrorKnot& knot : strips[1].knots) knot.position_std.z() = 0.08;
  EXPECT_TRUE(findExcursions(strips, OrdinaryErrors(strips, SharedErrorModel())).empty());
}

TEST(LargeCorrections, DoNotCrossLongGaps) {
  std::vector<StripErrors> strips = stripsWithHill();
  for (std::size_t i = 7; i < strips[1].knots.size(); ++i) strips[1].knots[i].time += 3600.0;
  const auto found = findExcursions(strips, OrdinaryErrors(strips, SharedErrorModel()));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].to, 106.0);
  EXPECT_EQ(found[1].from, 3707.0);
}

// Causes.

/// What a block of two strips knows: strip 1 from 100 to 120 s, strip 2 from 200 to 220 s.
struct Known {
  std::vector<TrajectorySample> samples;
  std::vector<StripTrajectory> strips;
  std::vector<AreaObservations> observations;
  std::vector<int> pass;
  std::optional<JumpSearch::Place> jump;

  Known() {
    for (int i = 0; i <= 1400; ++i) {
      TrajectorySample sample;
      sample.time = 90.0 + 0.1 * i;
      sample.position = {60.0 * (sample.time - 90.0), 0.0, 1000.0};
      sample.roll = sample.pitch = 0.0;
      sample.heading = 0.5 * kPi;
      samples.push_back(sample);
    }
    strips.push_back({"1", {100.0, 120.0}, 1000, 1000.0, 0.4});
    strips.push_back({"2", {200.0, 220.0}, 1000, 1000.0, 0.4});
    strips.push_back({"3", {225.0, 228.0}, 1000, 1000.0, 0.4});
  }

  /// The names of the causes of a correction of strip 1.
  std::vector<std::string> causesOf(double from, double to) const {
    LargeCorrection correction;
    correction.strip = "1";
    correction.axis = kUp;
    correction.value = 0.3;
    correction.from = from;
    correction.to = to;
    std::vector<LargeCorrection> corrections{correction};
    correction.strip = "2";
    correction.value = -0.3;
    corrections.push_back(correction);
    Trajectory::Options options;
    options.use_attitude = true;
    addCauses({Trajectory(samples, options), strips, observations, pass, jump}, corrections);
    std::vector<std::string> names;
    for (const CorrectionCause& cause : corrections.front().causes) names.push_back(cause.name);
    return names;
  }

  /// A pair of a point of strip \a a and a patch of strip \a b, counted from 0.
  void addPair(int a, double time_a, int b, double time_b) {
    PairObservation o;
    o.a = a;
    o.b = b;
    o.time_a = time_a;
    o.time_b = time_b;
    observations.push_back({o});
  }
};

using Names = std::vector<std::string>;

TEST(CorrectionCauses, AreNamedByTheirEvidence) {
  EXPECT_EQ(Known().causesOf(106.0, 112.0), Names());
  EXPECT_EQ(Known().causesOf(101.9, 106.0), Names{"strip_start"});
  EXPECT_EQ(Known().causesOf(102.1, 106.0), Names());
  EXPECT_EQ(Known().causesOf(113.0, 118.1), Names{"strip_end"});
  EXPECT_EQ(Known().causesOf(102.0, 118.1), Names{"whole_strip"});
  Known jump;
  jump.jump = JumpSearch::Place{"1", kUp, 113.0, 115.0, 0.3};
  EXPECT_EQ(jump.causesOf(106.0, 112.0), Names{"jump"});
  EXPECT_EQ(jump.causesOf(105.0, 110.9), Names());
  jump.jump->axis = 0;
  EXPECT_EQ(jump.causesOf(106.0, 112.0), Names());
}

TEST(CorrectionCauses, NameGapsOfTheTrajectory) {
  Known known;  // samples between 107.05 and 107.75 s are missing: 0.8 s without one
  known.samples.erase(known.samples.begin() + 171, known.samples.begin() + 178);
  EXPECT_EQ(known.causesOf(106.0, 112.0), Names{"trajectory_gap"});
  EXPECT_EQ(known.causesOf(109.0, 112.0), Names());
}

TEST(CorrectionCauses, NameTurnsAndRotations) {
  Known turn;  // 4 degrees per second from 108 to 110 s, to the left
  for (TrajectorySample& sample : turn.samples) {
    const double seconds = std::min(std::max(sample.time - 108.0, 0.0), 2.0);
    const double rate = 4.0 * kRadiansPerDegree, radius = 60.0 / rate;
    const double before = std::min(sample.time, 108.0) - 90.0;
    const double after = std::max(sample.time - 110.0, 0.0), angle = rate * seconds;
    sample.position.x() = 60.0 * before + radius * std::sin(angle) + 60.0 * after * std::cos(angle);
    sample.position.y() = radius * (1.0 - std::cos(angle)) + 60.0 * after * std::sin(angle);
  }
  EXPECT_EQ(turn.causesOf(104.0, 106.0), Names{"turn"});
  EXPECT_EQ(turn.causesOf(113.5, 115.0), Names());
  Known rolling;  // to 5 degrees within a second at 108 s
  for (TrajectorySample& sample : rolling.samples)
    sample.roll = 5.0 * kRadiansPerDegree * std::min(std::max(sample.time - 108.0, 0.0), 1.0);
  EXPECT_EQ(rolling.causesOf(104.0, 106.0), Names{"turn"});
  EXPECT_EQ(rolling.causesOf(112.5, 115.0), Names());
}

TEST(CorrectionCauses, NameASingleOtherStrip) {
  Known known;
  known.addPair(0, 107.0, 1, 210.0);
  known.addPair(2, 226.0, 0, 115.0);
  EXPECT_EQ(known.causesOf(106.0, 112.0), Names{"single_pair"});
  known.addPair(2, 226.0, 0, 111.0);
  EXPECT_EQ(known.causesOf(106.0, 112.0), Names());
  known.pass = {0, 1, 1};  // strips 2 and 3 are channels of one scanner
  EXPECT_EQ(known.causesOf(106.0, 112.0), Names{"single_pair"});
}

TEST(LargeCorrections, AreDescribed) {
  LargeCorrection correction;
  correction.strip = "4";
  correction.axis = kUp;
  correction.from = 401803.2;
  correction.to = 401808.9;
  correction.value = 0.2741;
  correction.std = 0.0312;
  correction.ordinary = 0.02;
  correction.on_ground = 0.2741;
  EXPECT_EQ(describe(correction),
            "strip 4, 401803 to 401809 s: up +0.274 +- 0.031 m (too high), 0.27 m on the ground, "
            "13.7 times an ordinary error; probable cause: no cause found in the data");
  correction.axis = kHeading;  // anticlockwise: less than the true heading
  correction.value = 100.0 * kRadiansPerArcsec;
  correction.std = 12.0 * kRadiansPerArcsec;
  EXPECT_EQ(sizeText(correction), "heading +100 +- 12 arcsec (its heading too small)");
}

// Simulated blocks.

test::SimulatedSurvey crossing(unsigned seed) {
  auto options = simulation::SimulationOptions::preset("small", 2.0, 0.15);
  options.noise = simulation::NoiseOptions::named("realistic");
  options.seed = seed;
  return test::SimulatedSurvey(options);
}

CalibrationResult calibratedWithControl(const test::SimulatedSurvey& survey) {
  test::SimulatedSurvey::Request request;
  request.control = survey.control;
  request.rigorous = true;
  request.settings.candidates = 10'000;
  request.settings.selection.point_budget = 200'000;
  return survey.calibrate(request).result;
}

/// An error of a strip's trajectory in six seconds in its middle, and of the points computed with
/// it.
struct Error {
  std::size_t strip = 0;
  double from = 0.0, to = 0.0;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double roll = 0.0;  ///< right wing down, rad

  Error(const test::SimulatedSurvey& survey, std::size_t in) : strip(in) {
    const auto& points = survey.strips[strip];
    const double middle = 0.5 * (points.front().time + points.back().time);
    from = middle - 3.0;
    to = middle + 3.0;
  }

  void apply(test::SimulatedSurvey& survey) const {
    const auto inside = [&](double time) { return time >= from && time < to; };
    const std::vector<TrajectorySample> truth = survey.trajectory;
    for (LidarReturn& point : survey.strips[strip]) {
      if (!inside(point.time)) continue;
      const auto at = std::lower_bound(
          truth.begin(), truth.end(), point.time,
          [](const TrajectorySample& sample, double time) { return sample.time < time; });
      const Eigen::Vector3d ahead(std::sin(at->heading), std::cos(at->heading), 0.0);
      const Eigen::Matrix3d turned = Eigen::AngleAxisd(roll, ahead).toRotationMatrix();
      point.position = at->position + turned * (point.position - at->position) + shift;
    }
    for (TrajectorySample& sample : survey.trajectory) {
      if (!inside(sample.time)) continue;
      sample.position += shift;
      sample.roll += roll;
    }
  }
};

void expectNamed(const Error& error, const CalibrationResult& result, std::size_t axis,
                 double value) {
  ASSERT_TRUE(result.converged);
  ASSERT_FALSE(result.large_corrections.empty());
  const LargeCorrection& first = result.large_corrections.front();
  EXPECT_EQ(first.strip, std::to_string(error.strip + 1)) << describe(first);
  EXPECT_EQ(first.axis, axis) << describe(first);
  const double common = std::min(first.to, error.to) - std::max(first.from, error.from);
  const double all = std::max(first.to, error.to) - std::min(first.from, error.from);
  EXPECT_GT(common, 0.5 * all) << describe(first);
  EXPECT_NEAR(first.value, value, 3.0 * first.std) << describe(first);
  EXPECT_LT(first.std, 0.25 * std::abs(value)) << describe(first);
}

TEST(LargeCorrections, NameAHeightError) {
  test::SimulatedSurvey survey = crossing(3);
  Error error(survey, 2);
  error.shift.z() = 0.27;
  error.apply(survey);
  const CalibrationResult result = calibratedWithControl(survey);
  expectNamed(error, result, kUp, 0.27);
}

TEST(LargeCorrections, NameARollError) {
  test::SimulatedSurvey survey = crossing(4);
  Error error(survey, 3);
  error.roll = -150.0 * kRadiansPerArcsec;
  error.apply(survey);
  const CalibrationResult result = calibratedWithControl(survey);
  expectNamed(error, result, kRoll, error.roll);
}

TEST(LargeCorrections, NameAnErrorAcrossTheStrip) {
  test::SimulatedSurvey survey = crossing(5);
  Error error(survey, 3);  // flown to the east
  error.shift.y() = -0.5;
  error.apply(survey);
  const CalibrationResult result = calibratedWithControl(survey);
  expectNamed(error, result, kNorth, -0.5);
}

/// All of its pairs are rejected: the strip corrections themselves do not show it.
TEST(LargeCorrections, NameAnErrorWhosePairsAreRejected) {
  test::SimulatedSurvey survey = crossing(6);
  Error error(survey, 2);
  error.shift.z() = -0.9;
  error.apply(survey);
  const CalibrationResult result = calibratedWithControl(survey);
  expectNamed(error, result, kUp, -0.9);
  for (const StripErrors& strip : result.strip_errors)
    for (const TrajectoryErrorKnot& knot : strip.knots) EXPECT_LT(knot.position.norm(), 0.3);
}

TEST(LargeCorrections, AreRejectedTogetherWhereMostPairsOfASecondAre) {
  PairSet pairs;
  PairObservation o;
  o.a = 0;
  o.b = 1;
  o.time_a = 107.3;
  o.time_b = 207.9;
  pairs.observations.push_back(AreaObservations(40, o));
  std::vector<std::vector<double>> weights{std::vector<double>(40, 1.0)};
  pairs.far.push_back(AreaObservations(40, o));
  EXPECT_FALSE(areRejectedTogether(pairs, weights));  // 40 of 80
  weights[0][7] = 0.0;
  EXPECT_TRUE(areRejectedTogether(pairs, weights));
  for (std::size_t i = 0; i < 20; ++i) pairs.observations[0][2 * i].time_a = 109.0;
  pairs.observations[0].resize(41, o);
  weights[0].resize(41, 1.0);
  EXPECT_TRUE(areRejectedTogether(pairs, weights));  // 41 of 61 of strip 1
  pairs.far[0].resize(9);
  EXPECT_FALSE(areRejectedTogether(pairs, weights));
}

TEST(LargeCorrections, AreRareWithoutErrors) {
  int listed = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const CalibrationResult result = calibratedWithControl(crossing(seed));
    EXPECT_TRUE(result.converged);
    for (const LargeCorrection& correction : result.large_corrections)
      std::cout << "seed " << seed << ": " << describe(correction) << '\n';
    listed += result.large_corrections.empty() ? 0 : 1;
  }
  EXPECT_LE(listed, 1);
}

}  // namespace
}  // namespace pcl_als
