// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Strips and reference surfaces that are held fixed.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "expected_truth.h"
#include "simulated_survey.h"

namespace pcl_als {
namespace {

using P = SystemParameter;
using simulation::NoiseOptions;
using simulation::SimulationOptions;
using test::expectTruth;
using test::SimulatedSurvey;

/// Few points: all statements are relative to the standard deviations that follow from them.
SimulationOptions sparseBlock(std::uint64_t seed) {
  SimulationOptions options = SimulationOptions::preset("small", 0.6, 0.35);
  options.noise = NoiseOptions::named("realistic");
  options.seed = seed;
  return options;
}

/// The block of a seed, simulated once.
const SimulatedSurvey& blockOf(std::uint64_t seed) {
  static std::map<std::uint64_t, SimulatedSurvey> blocks;
  return blocks.try_emplace(seed, sparseBlock(seed)).first->second;
}

/// A block whose strip 3 is that of an earlier delivery, without biases and with this noise.
SimulatedSurvey withEarlierStrip(std::uint64_t seed, const char* noise) {
  SimulationOptions options = sparseBlock(seed);
  options.bias.setZero();
  options.noise = NoiseOptions::named(noise);
  SimulatedSurvey survey = blockOf(seed);
  survey.strips[2].clear();
  for (const simulation::SimulatedPoint& p : simulation::Simulator(options).strip(2))
    survey.strips[2].push_back(SimulatedSurvey::pointOf(p));
  return survey;
}

/// Without biases and trajectory errors.
SimulatedSurvey withCorrectStrip(std::uint64_t seed) {
  return withEarlierStrip(seed, "range");
}

CalibrationSettings quickSettings() {
  CalibrationSettings settings;
  settings.candidates = 4'000;
  settings.selection.point_budget = 30'000;
  settings.threads = 1;
  settings.diagnose = false;  // half of the time
  return settings;
}

CalibrationResult calibratedToHeld(const SimulatedSurvey& survey, std::vector<std::string> fixed,
                                   double sigma = 0.02) {
  SimulatedSurvey::Request request;
  request.rigorous = true;
  request.settings = quickSettings();
  request.settings.fixed = std::move(fixed);
  request.settings.fixed_sigma = sigma;
  return survey.calibrate(request).result;
}

TEST(FixedStrips, DetermineTheRangeBias) {
  for (const std::uint64_t seed : {4U}) {  // also run with 5 and 6
    const SimulatedSurvey survey = withCorrectStrip(seed);
    const CalibrationResult result = calibratedToHeld(survey, {"3"});
    EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
    expectTruth(result, survey.bias);
    const ParameterEstimate& range = result[P::range_bias];
    ASSERT_EQ(range.status, ParameterStatus::estimated) << range.reason;
    EXPECT_LT(range.std, 0.035);  // the truth is larger
    EXPECT_GT(std::abs(survey.bias[indexOf(P::range_bias)]), 0.035);
    ASSERT_EQ(result.held.size(), 1U);
    EXPECT_EQ(result.held[0].strips, std::vector<std::string>{"3"});
    EXPECT_GT(result.held[0].correspondences, 1000U);
    EXPECT_LT(result.held[0].rms_after, 0.5 * result.held[0].rms_before);
    const auto is = [](const std::string& id) {
      return [id](const StripErrors& strip) { return strip.id == id; };
    };
    EXPECT_TRUE(std::any_of(result.strip_errors.begin(), result.strip_errors.end(), is("2")));
    EXPECT_FALSE(std::any_of(result.strip_errors.begin(), result.strip_errors.end(), is("3")));
  }
}

/// Without the option the block has no height, and strip 3 contradicts the others.
TEST(FixedStrips, AreNeededForIt) {
  const CalibrationResult result = calibratedToHeld(withCorrectStrip(4), {});
  EXPECT_NE(result[P::range_bias].status, ParameterStatus::estimated);
  EXPECT_TRUE(result.held.empty());
}

TEST(FixedStrips, MustExistAndLeaveOthers) {
  const SimulatedSurvey& survey = blockOf(4);
  EXPECT_THROW(calibratedToHeld(survey, {"9"}), UsageError);
  EXPECT_THROW(calibratedToHeld(survey, {"1", "2", "3", "4", "5"}), UsageError);
  EXPECT_THROW(calibratedToHeld(survey, {"3"}, -0.01), UsageError);
}

/// Strip 3 is too high by 12 cm, twice the standard deviation that is stated for it: the range bias
/// is wrong by as much, which its standard deviation includes, unless they are stated as exact.
TEST(FixedStrips, HaveAnErrorInCommon) {
  SimulatedSurvey survey = withCorrectStrip(4);
  for (LidarReturn& point : survey.strips[2]) point.position.z() += 0.12;
  const CalibrationResult result = calibratedToHeld(survey, {"3"}, 0.06),
                          certain = calibratedToHeld(survey, {"3"}, 0.0);
  expectTruth(result, survey.bias);
  const double truth = survey.bias[indexOf(P::range_bias)];
  EXPECT_GT(result[P::range_bias].std, 0.03);
  EXPECT_GT(std::abs(certain[P::range_bias].bias - truth), 4.0 * certain[P::range_bias].std);
  EXPECT_EQ(result.held[0].offset_prior, 0.06);
}

/// A fixed strip with trajectory errors of its own, as the others have: what they would move by is
/// part of the standard deviations.
TEST(FixedStrips, HaveTrajectoryErrors) {
  const SimulatedSurvey survey = withEarlierStrip(4, "realistic");
  const CalibrationResult result = calibratedToHeld(survey, {"3"}, 0.0);
  expectTruth(result, survey.bias);
  // A priori 2 cm of the strip's height, of which other strips determine little; without: 1.1 cm.
  EXPECT_GT(result[P::range_bias].std, 0.015);
}

/// Points of another survey of the same scene, without errors of a system: every fifth point, with
/// a noise of 2 cm.
std::vector<LidarReturn> referencePoints(const SimulationOptions& like, double shift = 0.0) {
  SimulationOptions options = like;
  options.bias.setZero();
  options.noise = NoiseOptions::named("none");
  std::mt19937_64 random(like.seed);
  std::normal_distribution<double> noise(shift, 0.02);
  std::vector<LidarReturn> points;
  for (const auto& strip : SimulatedSurvey(options).strips) {
    for (std::size_t i = 0; i < strip.size(); i += 5) {
      points.push_back(strip[i]);
      points.back().position.z() += noise(random);
      points.back().time = 0.0;
    }
  }
  return points;
}

const ReferenceSurface kSurface{"dem.laz", 0.02, 0.0};

struct Compared {
  ReferenceSurface surface;
  std::vector<LidarReturn> points;
  std::vector<ControlPoint> control;
  std::vector<std::size_t> strips;  ///< of the survey; empty: all
};

CalibrationResult calibratedWith(const SimulatedSurvey& survey, const Compared& with) {
  BlockIndex index(survey.flight(true), survey.corner());
  std::vector<std::size_t> strips = with.strips;
  for (std::size_t i = 0; with.strips.empty() && i < survey.strips.size(); ++i) strips.push_back(i);
  for (const std::size_t i : strips) index.addStrip(std::to_string(i + 1));
  const int reference = index.addReference(with.surface);
  const auto each = [&](const auto& use) {
    for (std::size_t k = 0; k < strips.size(); ++k)
      use(static_cast<int>(k), survey.strips[strips[k]].data(), survey.strips[strips[k]].size());
    use(reference, with.points.data(), with.points.size());
  };
  each([&](int strip, const LidarReturn* p, std::size_t n) { index.add(strip, p, n); });
  const SurveyBlock block = chooseAreas(std::move(index), {quickSettings(), with.control, {}});
  AreaSample sample(block);
  each([&](int strip, const LidarReturn* p, std::size_t n) { sample.add(strip, p, n); });
  return calibrate(sample).result;
}

TEST(ReferenceSurfaces, DetermineTheAbsoluteParameters) {
  for (const std::uint64_t seed : {14U}) {  // also run with 11 and 12
    const SimulationOptions options = sparseBlock(seed);
    const SimulatedSurvey& survey = blockOf(seed);
    const CalibrationResult result =
        calibratedWith(survey, {kSurface, referencePoints(options), {}, {}});
    EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
    expectTruth(result, survey.bias);
    ASSERT_EQ(result[P::range_bias].status, ParameterStatus::estimated);
    EXPECT_LT(result[P::range_bias].std, 0.03);
    ASSERT_EQ(result.held.size(), 1U);
    EXPECT_TRUE(result.held[0].strips.empty());
    EXPECT_LT(result.held[0].rms_after, 0.5 * result.held[0].rms_before);
    EXPECT_NEAR(result.held[0].offset, 0.0, 4.0 * result.held[0].offset_std);
  }
}

TEST(ReferenceSurfaces, AreComparedWithControl) {
  const SimulationOptions options = sparseBlock(14);
  const SimulatedSurvey& survey = blockOf(14);
  const auto with = [&](double shift) {
    return calibratedWith(survey, {kSurface, referencePoints(options, shift), survey.control, {}});
  };
  const auto named = [](const CalibrationResult& result) {
    return std::any_of(result.warnings.begin(), result.warnings.end(), [](const Warning& w) {
      return w.text.find("dem.laz lies") != std::string::npos;
    });
  };
  const CalibrationResult right = with(0.0), wrong = with(0.10);
  EXPECT_FALSE(named(right));
  EXPECT_TRUE(right.held[0].offset_determined);
  EXPECT_NEAR(right.held[0].offset, 0.0, 4.0 * right.held[0].offset_std);
  EXPECT_TRUE(named(wrong));
  EXPECT_NEAR(wrong.held[0].offset, 0.10, 4.0 * wrong.held[0].offset_std);
  EXPECT_LT(wrong.held[0].offset_std, 0.02);
}

TEST(ReferenceSurfaces, MayHaveACommonOffset) {
  const SimulationOptions options = sparseBlock(14);
  const SimulatedSurvey& survey = blockOf(14);
  Compared with{{"dem.laz", 0.02, 0.5}, referencePoints(options, 0.10), survey.control, {1, 2, 3}};
  const CalibrationResult result = calibratedWith(survey, with);
  EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
  expectTruth(result, survey.bias);
  EXPECT_NEAR(result.held[0].mean_after, 0.0, 0.01);  // the surface counts as lower by its offset
}

/// A flat surface under one strip shows heights only: range bias, roll and scan angle scale.
TEST(ReferenceSurfaces, OnFlatGroundDetermineHeightsOnly) {
  SimulationOptions options = sparseBlock(15);
  options.scene.relief = options.scene.buildings = options.scene.trees = 0.0;
  const SimulatedSurvey survey(options);
  const CalibrationResult result =
      calibratedWith(survey, {kSurface, referencePoints(options), {}, {0}});
  for (const P p : {P::boresight_pitch, P::boresight_heading, P::lever_arm_y}) {
    EXPECT_EQ(result[p].status, ParameterStatus::not_estimable) << infoOf(p).name;
    EXPECT_FALSE(result[p].reason.empty()) << infoOf(p).name;
  }
  expectTruth(result, survey.bias);
}

std::string refusal(const SimulatedSurvey& survey, std::vector<LidarReturn> points) {
  try {
    calibratedWith(survey, {kSurface, std::move(points), {}, {}});
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(ReferenceSurfaces, ThatDoNotBelongToTheBlockAreRefused) {
  const SimulationOptions options = sparseBlock(14);
  const SimulatedSurvey& survey = blockOf(14);
  auto elsewhere = referencePoints(options), in_feet = elsewhere;
  for (LidarReturn& point : elsewhere) point.position.x() += 10'000.0;
  for (LidarReturn& point : in_feet) point.position.z() /= 0.3048;
  EXPECT_NE(refusal(survey, elsewhere).find("dem.laz: overlaps no strip"), std::string::npos);
  EXPECT_NE(refusal(survey, in_feet).find("in another unit"), std::string::npos);
  EXPECT_NE(refusal(survey, {}).find("overlaps no strip"), std::string::npos);
  EXPECT_THROW(calibratedWith(survey, {{"dem.laz", 0.0, 0.0}, {}, {}, {}}), UsageError);
  EXPECT_THROW(calibratedWith(survey, {{"2", 0.02, 0.0}, {}, {}, {}}), UsageError);
}

/// Centres of roofs: places where points without noise lie on a plane of 15 degrees and more.
std::vector<ControlPoint> roofs(const SimulationOptions& like) {
  SimulationOptions options = like;
  options.bias.setZero();
  options.noise = NoiseOptions::named("none");
  std::vector<LidarReturn> points;
  for (const auto& strip : SimulatedSurvey(options).strips)
    points.insert(points.end(), strip.begin(), strip.end());
  std::vector<ControlPoint> found;
  for (std::size_t i = 0; i < points.size() && found.size() < 60; i += 97) {
    std::vector<Eigen::Vector3d> near;
    for (const LidarReturn& p : points)
      if ((p.position - points[i].position).norm() < 1.5) near.push_back(p.position);
    if (near.size() < 8) continue;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : near) centre += p / static_cast<double>(near.size());
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& p : near) moments += (p - centre) * (p - centre).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
    Eigen::Vector3d normal = solver.eigenvectors().col(0);
    if (normal.z() < 0.0) normal = -normal;
    const double rms = std::sqrt(solver.eigenvalues()[0] / static_cast<double>(near.size()));
    if (rms > 0.002 || normal.z() > 0.966 || normal.z() < 0.6) continue;
    ControlPoint patch;
    patch.id = "roof" + std::to_string(found.size());
    patch.position = centre;
    patch.sigma = 0.01;
    patch.kind = ControlPoint::Kind::patch;
    patch.normal = normal;
    patch.extent = 2.0;
    found.push_back(patch);
  }
  return found;
}

/// Roofs show shifts in all directions: with them a block has its absolute position.
TEST(ControlPatches, AreUsedAlongTheirNormals) {
  const SimulationOptions options = sparseBlock(21);
  const SimulatedSurvey& survey = blockOf(21);
  SimulatedSurvey::Request request;
  request.rigorous = true;
  request.settings = quickSettings();
  request.control = roofs(options);
  ASSERT_GT(request.control.size(), 10U);
  const CalibrationResult result = survey.calibrate(request).result;
  EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
  expectTruth(result, survey.bias);
  ASSERT_EQ(result[P::range_bias].status, ParameterStatus::estimated);
  ASSERT_GT(result.control_points.size(), 10U);
  double before = 0.0, after = 0.0;
  for (const ControlPointFit& fit : result.control_points) {
    EXPECT_EQ(fit.component, "normal");
    before += std::abs(fit.before);
    after += std::abs(fit.after);
  }
  EXPECT_LT(after, 0.4 * before);
}

}  // namespace
}  // namespace pcl_als
