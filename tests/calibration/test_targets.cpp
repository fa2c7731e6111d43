// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Targets as control: their equations by AreaMatcher, and calibrations with them.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/statistics.h>

#include "area_matcher.h"
#include "expected_truth.h"
#include "simulated_survey.h"

namespace pcl_als {
namespace {

using P = SystemParameter;
using simulation::NoiseOptions;
using simulation::SimulationOptions;
using test::expectTruth;
using test::SimulatedSurvey;

constexpr double kRadius = 1.0;
const SurveyArea kTargetArea{{15.0, 15.0}, 20.0, 6.0};
const Eigen::Vector3d kTarget(25.3, 24.8, 100.0);

/// Oblique to the axes, with attitude that changes.
std::shared_ptr<const Trajectory> obliqueFlight() {
  std::vector<TrajectorySample> samples;
  const Eigen::Vector2d course(std::sin(0.5), std::cos(0.5));
  for (int i = 0; i <= 200; ++i) {
    TrajectorySample sample;
    sample.time = 0.1 * i;
    const Eigen::Vector2d at = kTarget.head<2>() + 60.0 * (sample.time - 10.0) * course +
                               200.0 * Eigen::Vector2d(course.y(), -course.x());
    sample.position = Eigen::Vector3d(at.x(), at.y(), 900.0);
    sample.roll = 0.01 * std::sin(sample.time);
    sample.pitch = 0.02;
    sample.heading = 0.5 + 0.03;
    samples.push_back(sample);
  }
  Trajectory::Options options;
  options.use_attitude = true;
  return std::make_shared<const Trajectory>(samples, options);
}

/// Level ground with a target that stands \a raised above it.
std::vector<LidarReturn> ground(unsigned seed, const Eigen::Vector3d& shift, double raised,
                                float bright = 400.0F) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<LidarReturn> points;
  for (double x = 8.0; x < 42.0; x += 0.25) {
    for (double y = 8.0; y < 42.0; y += 0.25) {
      LidarReturn p;
      const Eigen::Vector2d at(x + 0.05 * normal(random), y + 0.05 * normal(random));
      const bool on_target = (at - kTarget.head<2>()).norm() < kRadius;
      p.position =
          Eigen::Vector3d(at.x(), at.y(), kTarget.z() - (on_target ? 0.0 : raised)) + shift;
      p.position.z() += 0.01 * normal(random);
      p.intensity = (on_target ? bright : 100.0F) + static_cast<float>(5.0 * normal(random));
      p.time = 10.0 + 0.005 * (at.y() - 25.0);
      points.push_back(p);
    }
  }
  return points;
}

ControlPoint target() {
  ControlPoint point{"T", kTarget, 0.01};
  point.kind = ControlPoint::Kind::target;
  point.diameter = 2.0 * kRadius;
  point.sigma_plan = 0.02;
  return point;
}

AreaMatcher matcherOfStrips(const std::vector<std::vector<LidarReturn>>& strips) {
  AreaMatcher matcher(kTargetArea, strips.size());
  for (std::size_t i = 0; i < strips.size(); ++i)
    for (const LidarReturn& p : strips[i]) matcher.add(static_cast<int>(i), p);
  matcher.prepare(SurfaceCriterion(), 0, 0.001, *obliqueFlight());
  return matcher;
}

/// The vector from the target in a strip to the surveyed one, for biases.
Eigen::Vector3d differenceIn(const AreaObservations& found, int strip, const SystemVector& biases) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const PairObservation& o : found)
    if (o.b == strip) sum += o.distance(biases) * o.normal;
  return sum;
}

TEST(Targets, ShowShiftsInThreeDimensions) {
  const Eigen::Vector3d shift(0.35, -0.6, 0.15);
  for (const double raised : {0.0, 1.2}) {
    const AreaMatcher matcher =
        matcherOfStrips({ground(1, shift, raised), ground(2, {0, 0, 0}, raised)});
    const AreaObservations found =
        matcher.matchControl({target()}, 2.0, *obliqueFlight(), NoiseModel(), 0.01);
    ASSERT_EQ(found.size(), 6U);
    EXPECT_LT((differenceIn(found, 0, SystemVector::Zero()) + shift).cwiseAbs().maxCoeff(), 0.10);
    EXPECT_LT(differenceIn(found, 1, SystemVector::Zero()).cwiseAbs().maxCoeff(), 0.10);
    EXPECT_NEAR(differenceIn(found, 0, SystemVector::Zero()).z(), -shift.z(), 0.01);
    for (const PairObservation& o : found) {
      EXPECT_EQ(o.isInPlan(), o.normal.z() == 0.0);
      EXPECT_NEAR(o.normal.norm(), 1.0, 1e-12);
      const double sigma = o.isInPlan() ? 0.02 : 0.01;
      EXPECT_GT(o.variance, sigma * sigma);
      EXPECT_LT(std::sqrt(o.variance), 0.08);
      EXPECT_GT(o.variance_inflation, 1.0);
      EXPECT_LT(o.variance_inflation, 1.0 + std::sqrt(2.0));
    }
  }
}

TEST(Targets, AreNotUsedWhereTheyAreNotSeen) {
  const AreaMatcher matcher =
      matcherOfStrips({ground(1, {0, 0, 0}, 0.0, 100.0F), ground(2, {0, 0, 0}, 0.0)});
  const AreaObservations found =
      matcher.matchControl({target()}, 2.0, *obliqueFlight(), NoiseModel(), 0.01);
  ASSERT_EQ(found.size(), 3U);
  for (const PairObservation& o : found) EXPECT_EQ(o.b, 1);
  const std::vector<TargetInStrip> all =
      matcher.targetsIn(target(), 2.0, *obliqueFlight(), NoiseModel());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].status, TargetStatus::no_contrast);
  EXPECT_EQ(all[1].status, TargetStatus::located);
}

/// The rows are the derivatives of the target's place in the corrected points, located anew.
TEST(Targets, RowsAreDerivatives) {
  const auto trajectory = obliqueFlight();
  AreaMatcher matcher = matcherOfStrips({ground(3, {0, 0, 0}, 0.0)});
  const AreaObservations here =
      matcher.matchControl({target()}, 2.0, *trajectory, NoiseModel(), 0.01);
  ASSERT_EQ(here.size(), 3U);
  for (const SystemParameterInfo& info : systemParameters()) {
    SystemVector step = SystemVector::Zero();
    step[indexOf(info.parameter)] = info.unit == "m" ? 0.2 : 2e-4;  // up to 0.2 m on the ground
    std::array<Eigen::Vector3d, 2> corrected;
    for (const int side : {0, 1}) {
      const SystemVector biases = side == 0 ? step : SystemVector(-step);
      matcher.correct(BiasEvaluator(trajectory, biases), *trajectory);
      const AreaObservations moved =
          matcher.matchControl({target()}, 2.0, *trajectory, NoiseModel(), 0.01);
      ASSERT_EQ(moved.size(), 3U) << info.name;
      // Of the corrected points: the place is that of these points, not of the model.
      corrected[static_cast<std::size_t>(side)] = differenceIn(moved, 0, biases);
      // The misclosure is that of the points as measured.
      const Eigen::Vector3d measured = differenceIn(moved, 0, SystemVector::Zero());
      EXPECT_LT((measured - differenceIn(here, 0, SystemVector::Zero())).norm(), 0.01) << info.name;
    }
    const Eigen::Vector3d slope = 0.5 * (corrected[0] - corrected[1]);
    Eigen::Vector3d expected = Eigen::Vector3d::Zero();
    for (const PairObservation& o : here) expected -= o.row().dot(step) * o.normal;
    EXPECT_LT((slope - expected).norm(), 0.005) << info.name;
  }
}

/// A simulated block with targets of 3 m, about three points on them in each square metre.
SimulationOptions blockWithTargets(std::uint64_t seed) {
  SimulationOptions options = SimulationOptions::preset("small", 0.6, 2.0);
  options.noise = NoiseOptions::named("realistic");
  options.seed = seed;
  options.control_points = 0;
  options.targets = 10;
  options.target_diameter = 3.0;
  return options;
}

CalibrationResult calibratedOnTargets(const SimulatedSurvey& survey) {
  SimulatedSurvey::Request request;
  request.rigorous = true;
  request.settings.candidates = 4'000;
  request.settings.selection.point_budget = 60'000;
  request.settings.threads = 1;
  request.settings.diagnose = false;
  request.control = survey.control;
  return survey.calibrate(request).result;
}

TEST(Targets, FitWithinTheirStandardDeviations) {
  RunningStatistics standardised, errors, std;
  std::size_t heights = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const SimulatedSurvey survey(blockWithTargets(seed));
    ASSERT_EQ(survey.control.size(), 10U);
    const CalibrationResult result = calibratedOnTargets(survey);
    EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
    expectTruth(result, survey.bias);
    EXPECT_EQ(result[P::range_bias].status, ParameterStatus::estimated);
    for (const ControlPointFit& fit : result.control_points) {
      EXPECT_TRUE(fit.used) << fit.id << ' ' << fit.component;
      heights += fit.component == "height" ? 1 : 0;
      if (!fit.isInPlan()) continue;
      standardised.add(fit.after / fit.expected_std);
      errors.add(fit.after);
      std.add(fit.expected_std);
    }
  }
  EXPECT_GT(heights, 25U);
  EXPECT_GT(standardised.count(), 50U);
  EXPECT_GT(standardised.rms(), 0.45);
  EXPECT_LT(standardised.rms(), 1.2);
  EXPECT_LT(std.mean(), 0.12);
  std::printf("%zu coordinates: RMS %.3f m, expected %.3f m, error/std %.2f\n", errors.count(),
              errors.rms(), std.mean(), standardised.rms());
}

/// Strips that agree with each other do not show it.
TEST(Targets, ShowADatumInPlan) {
  SimulatedSurvey survey(blockWithTargets(1));
  const Eigen::Vector3d shift(0.25, -0.15, 0.0);
  for (ControlPoint& point : survey.control) point.position -= shift;
  const CalibrationResult result = calibratedOnTargets(survey);
  expectTruth(result, survey.bias);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), weights = Eigen::Vector2d::Zero();
  for (const ControlPointFit& fit : result.control_points) {
    if (!fit.isInPlan()) continue;
    const int axis = fit.component == "east" ? 0 : 1;
    const double weight = 1.0 / (fit.expected_std * fit.expected_std);
    sum[axis] += weight * fit.after;
    weights[axis] += weight;
  }
  for (const int axis : {0, 1})
    EXPECT_NEAR(sum[axis] / weights[axis], shift[axis], 4.0 / std::sqrt(weights[axis]));
  const std::vector<std::string> warnings = textsOf(result.warnings);
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& text) {
    return text.find("targets fit in plan with an RMS of") != std::string::npos;
  }));
}

/// Parallel lines in one direction: the lever arm across the flight moves all of them alike.
TEST(Targets, DetermineTheLeverArm) {
  for (const std::uint64_t seed : {4U, 5U, 6U}) {
    SimulationOptions options = blockWithTargets(seed);
    std::vector<simulation::PlannedLine> lines(options.lines.begin() + 2, options.lines.end());
    for (simulation::PlannedLine& line : lines)
      if (line.start.x() > line.end.x()) std::swap(line.start, line.end);
    options.lines = lines;
    SimulatedSurvey survey(options);
    const CalibrationResult with = calibratedOnTargets(survey);
    survey.control.resize(1);
    survey.control[0].kind = ControlPoint::Kind::height;
    const CalibrationResult without = calibratedOnTargets(survey);
    expectTruth(with, survey.bias);
    for (const P p : {P::lever_arm_x, P::boresight_pitch}) {
      EXPECT_EQ(with[p].status, ParameterStatus::estimated) << infoOf(p).name;
      EXPECT_EQ(without[p].status, ParameterStatus::not_estimable) << infoOf(p).name;
    }
    EXPECT_LT(with[P::lever_arm_x].std, 0.06);
    EXPECT_LT(with[P::boresight_pitch].std, 30.0 * kRadiansPerArcsec);
  }
}

}  // namespace
}  // namespace pcl_als
