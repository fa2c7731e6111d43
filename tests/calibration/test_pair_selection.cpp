// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <pcl_als/trajectory/scan_geometry.h>

#include "pair_selection.h"
#include "pair_weights.h"

namespace pcl_als {
namespace {

using Weights = std::vector<std::vector<double>>;

/// A pair of two opposite lines at 1000 m over a surface with this normal, x metres to the right of
/// the first.
PairObservation pairAt(double x, const Eigen::Vector3d& normal, int a = 0, int b = 1) {
  PairObservation o;
  o.a = a;
  o.b = b;
  o.time_a = 10.0 * a;
  o.time_b = 10.0 * b;
  o.normal = normal;
  o.variance = 4e-4F;
  for (const bool second : {false, true}) {
    ScanGeometry g;
    g.x = second ? -x : x;
    g.z = -1000.0;
    g.beta = -std::atan2(g.x, -g.z);
    if (second) g.rotation = Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal();
    (second ? o.row_b : o.row_a) = (normal.transpose() * designBlock(g)).cast<float>();
  }
  return o;
}

Weights equalWeights(const std::vector<AreaObservations>& areas) {
  Weights weights;
  for (const AreaObservations& area : areas) weights.emplace_back(area.size(), 1.0);
  return weights;
}

/// Ten areas: much flat ground, few slopes.
std::vector<AreaObservations> mostlyFlat() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<AreaObservations> areas(10);
  for (AreaObservations& area : areas) {
    const double x = 300.0 * uniform(random);
    for (int i = 0; i < 1000; ++i) area.push_back(pairAt(x, Eigen::Vector3d::UnitZ()));
    for (int i = 0; i < 60; ++i) {
      const double aspect = 3.14 * uniform(random);
      area.push_back(pairAt(
          x, Eigen::Vector3d(0.4 * std::cos(aspect), 0.4 * std::sin(aspect), 1.0).normalized()));
    }
  }
  return areas;
}

/// Two strips, known but for errors far smaller than a pair's noise.
struct TwoStrips {
  explicit TwoStrips(std::vector<AreaObservations> given)
      : areas(std::move(given)),
        weights(equalWeights(areas)),
        errors({{0.0, 1.0}, {10.0, 11.0}, {20.0, 21.0}, {30.0, 31.0}}, model()),
        adjustment(errors) {
    adjustment.accumulate(areas, weights);
  }
  static SharedErrorModel model() {
    SharedErrorModel model;
    model.position = model.local = 1e-5;
    model.roll_pitch = model.heading = 1e-8;
    for (SharedErrorModel::SourcePrior& prior : model.sources) prior = {1e-8, 0.5};
    return model;
  }
  AdjustmentSolution solution() const { return adjustment.solve(kShown, SystemVector::Zero()); }
  PairSelection choose(const PairSelectionSettings& settings) const {
    return {areas, weights, adjustment, solution(), settings};
  }

  static const std::vector<SystemParameter> kShown;
  std::vector<AreaObservations> areas;
  Weights weights;
  SharedErrors errors;
  Adjustment adjustment;
};
const std::vector<SystemParameter> TwoStrips::kShown = {SystemParameter::lever_arm_x,
                                                        SystemParameter::boresight_pitch,
                                                        SystemParameter::boresight_roll};

/// Gives every pair noise of its own.
std::vector<AreaObservations> withNoise(std::vector<AreaObservations> areas, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 0.02);
  for (AreaObservations& area : areas) {
    for (PairObservation& o : area) o.misclosure = normal(random);
  }
  return areas;
}

/// The chosen pairs as they are adjusted.
TwoStrips chosenOf(const TwoStrips& block, const PairSelection& selection, bool offsets) {
  std::vector<AreaObservations> kept(block.areas.size());
  for (std::size_t area = 0; area < kept.size(); ++area) {
    for (const ChosenPair& pair : selection.chosen()[area]) {
      PairObservation o = block.areas[area][pair.index];
      o.variance /= pair.represented;
      if (offsets) o.misclosure += pair.offset;
      kept[area].push_back(o);
    }
  }
  return TwoStrips(kept);
}

/// How far estimates from chosen pairs scatter about those from all of them, in deviations of the
/// latter: the root of the mean over draws of the noise and parameters.
double scatterAbout(bool offsets) {
  constexpr unsigned kDraws = 40;
  double sum = 0.0;
  for (unsigned draw = 0; draw < kDraws; ++draw) {
    const TwoStrips block(withNoise(mostlyFlat(), draw));
    const AdjustmentSolution all = block.solution();
    const AdjustmentSolution part = chosenOf(block, block.choose({800, 0.25}), offsets).solution();
    for (const SystemParameter p : TwoStrips::kShown) {
      const double difference = part.biases[indexOf(p)] - all.biases[indexOf(p)];
      sum += difference * difference / all.formal(indexOf(p), indexOf(p)) / (3.0 * kDraws);
    }
  }
  return std::sqrt(sum);
}

TEST(PairSelection, KeepsEverythingWithinTheBudget) {
  const TwoStrips block(mostlyFlat());
  const PairSelection selection = block.choose({20000, 0.25});
  EXPECT_EQ(selection.chosenCount(), 10600U);
  EXPECT_EQ(selection.chosen()[0][0].represented, 1.0);
}

TEST(PairSelection, TellsWhatAllPairsTell) {
  // 7.5 % of the pairs, evenly thinned, would scatter by sqrt(1 / 0.075 - 1) = 3.5 deviations.
  EXPECT_LT(scatterAbout(false), 2.5);
  EXPECT_LT(scatterAbout(true), 0.3);
}

/// Sums over pairs of what residuals show of a displacement, its changes with either strip's time,
/// and a ranging share.
using Shown = Eigen::Matrix<double, 10, 1>;
Shown shownBy(const TwoStrips& block) {
  const AdjustmentSolution zero = block.adjustment.unsolved(SystemVector::Zero());
  Shown sum = Shown::Zero();
  for (const PairObservation& o : block.areas[0]) {
    Shown row;
    row << o.normal, o.time_a * o.normal, o.time_b * o.normal,
        o.sources[indexOf(ErrorSource::slope_ranging)];
    sum += row * block.adjustment.residual(o, zero) / o.variance;
  }
  return sum;
}

TEST(PairSelection, ChosenResidualsSumToThoseOfAll) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<AreaObservations> areas(1);
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d up(0.4 * normal(random), 0.4 * normal(random), 1.0);
    PairObservation o = pairAt(100.0, up.normalized());
    o.time_a = uniform(random), o.time_b = 10.0 + uniform(random);
    o.sources[indexOf(ErrorSource::slope_ranging)] = static_cast<float>(0.1 * normal(random));
    o.misclosure = 0.02 * normal(random);
    areas[0].push_back(o);
  }
  const TwoStrips block(areas);
  const AdjustmentSolution zero = block.adjustment.unsolved(SystemVector::Zero());
  const PairSelection selection(block.areas, block.weights, block.adjustment, zero, {500, 0.25});
  const Shown all = shownBy(block), part = shownBy(chosenOf(block, selection, true)),
              alone = shownBy(chosenOf(block, selection, false));
  EXPECT_LT((part - all).norm(), 0.02 * (alone - all).norm());
  EXPECT_LT((part - all).head<3>().norm(), 1e-5 * (alone - all).head<3>().norm());
}

TEST(PairSelection, WeighsWhatItKeepsAsMuchAsAll) {
  const TwoStrips block(mostlyFlat());
  const PairSelection selection = block.choose({800, 0.25});
  double stood_for = 0.0;
  for (const auto& pairs : selection.chosen()) {
    for (const ChosenPair& pair : pairs) stood_for += pair.represented;
  }
  EXPECT_NEAR(stood_for, 10600.0, 0.03 * 10600.0);  // groups of which no pair was taken are missing
}

TEST(PairSelection, LeavesNoMeetingOfStripsUnseen) {
  auto areas = mostlyFlat();
  areas.emplace_back();  // an area that tells nothing new
  for (int i = 0; i < 500; ++i) areas.back().push_back(pairAt(0.0, Eigen::Vector3d::UnitZ(), 2, 3));
  const PairSelection selection = TwoStrips(areas).choose({800, 0.25});
  EXPECT_GE(selection.chosen().back().size(), 15U);  // 200 pairs over 11 pairs of strips in areas
}

TEST(PairSelection, NeverTakesOutliersAndAlwaysControl) {
  auto areas = mostlyFlat();
  areas.emplace_back();
  PairObservation control = pairAt(0.0, Eigen::Vector3d::UnitZ());
  control.a = PairObservation::kControl;
  control.row_a.setZero();
  areas.back().push_back(control);
  TwoStrips block(areas);
  for (std::size_t i = 0; i < block.weights[3].size(); i += 2) block.weights[3][i] = 0.0;
  const PairSelection selection = block.choose({800, 0.25});
  for (const ChosenPair& pair : selection.chosen()[3]) EXPECT_EQ(pair.index % 2, 1U);
  ASSERT_EQ(selection.chosen().back().size(), 1U);
  EXPECT_EQ(selection.chosen().back()[0].represented, 1.0);
}

TEST(PairWeights, FindsHowWellASystemPoints) {
  // Half of the variance of slopes is said to come from pointing, and none does: residuals of
  // slopes are half as large (in variance) as said, those of flat ground are as said.
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  std::vector<AreaObservations> areas(1);
  PairWeights::Residuals residuals(1);
  for (int i = 0; i < 4000; ++i) {
    PairObservation o = pairAt(100.0, Eigen::Vector3d::UnitZ());
    const bool slope = i % 2 == 0;
    o.pointing = slope ? 4e-4 : 0.0;
    o.variance = 4e-4 + o.pointing;
    areas[0].push_back(o);
    residuals[0].emplace_back(o, 0.02 * normal(random));
  }
  PairWeights weights;
  weights.findScales(residuals);
  weights.update(residuals, true);
  EXPECT_LE(weights.factors().pointing, 0.1);
  // Weight over the model's variance: slopes count as much as flat ground.
  EXPECT_NEAR(weights.weights()[0][0] / areas[0][0].variance,
              weights.weights()[0][1] / areas[0][1].variance, 0.1 / 4e-4);
  EXPECT_NEAR(weights.sigma0(), std::sqrt(0.75), 0.03);  // against the noise as given
}

// Every other echo states a standard deviation of 2 cm of its range, and the common noise is 5 mm
// in place of the 2 cm of the model: of the variances 4 and 8 cm^2 that the model gives, those of
// the data are 0.25 and 4.25 cm^2, in the ratio of echoes with 16 times their part.
TEST(PairWeights, FindsTheNoiseThatEchoesState) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<AreaObservations> areas(1);
  PairWeights::Residuals residuals(1);
  for (int i = 0; i < 4000; ++i) {
    PairObservation o = pairAt(100.0, Eigen::Vector3d::UnitZ());
    o.echo = i % 2 == 0 ? 4e-4F : 0.0F;
    o.pointing = 0.0F;
    o.variance = 4e-4F + o.echo;
    areas[0].push_back(o);
    residuals[0].emplace_back(o, std::sqrt(i % 2 == 0 ? 4.25e-4 : 0.25e-4) * normal(random));
  }
  PairWeights weights;
  weights.findScales(residuals);
  weights.update(residuals, false);
  EXPECT_EQ(weights.factors().echo, 16.0);
  EXPECT_EQ(weights.factors().pointing, 1.0);
  EXPECT_NEAR(weights.meanScale(), 0.25, 0.01);
}

TEST(PairWeights, RejectsOutliersOnlyWhenAsked) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<AreaObservations> areas(1);
  PairWeights::Residuals residuals(1);
  for (int i = 0; i < 1000; ++i) {
    areas[0].push_back(pairAt(100.0, Eigen::Vector3d::UnitZ()));
    residuals[0].emplace_back(areas[0].back(), i % 10 == 0 ? 0.5 : 0.02 * normal(random));
  }
  PairWeights weights;
  weights.findScales(residuals);
  weights.update(residuals, true);
  EXPECT_EQ(weights.weights()[0][0], 0.0);
  EXPECT_NEAR(static_cast<double>(weights.kept()), 900.0, 1.0);
  weights.update(residuals, false);
  EXPECT_EQ(weights.kept(), 1000U);
  EXPECT_LT(weights.weights()[0][0], 0.1);  // Huber: 1.5 of some 25 standard deviations
}

}  // namespace
}  // namespace pcl_als
