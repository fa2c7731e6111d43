// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The phases of the iteration, driven by hand.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "block_estimate.h"

namespace pcl_als {
namespace {

using P = SystemParameter;

/// An iteration whose updates are given.
class Driven {
 public:
  explicit Driven(const CalibrationSettings& settings = {})
      : settings_(settings),
        rules_{settings_, true, true, {}},
        solution_(SharedErrors({{0.0, 10.0}}, SharedErrorModel()), 1),
        control_(settings_) {
    solution_.choice.estimate = {P::boresight_roll, P::boresight_pitch};
    pairs_.observations.resize(1);
    pairs_.observations[0].resize(100);
    for (const P p : solution_.choice.estimate)
      solution_.choice.solution.covariance(indexOf(p), indexOf(p)) = 1.0;
  }

  bool continues() { return control_.continues(pairs_.count(), rules_, solution_); }

  /// An iteration that changes the roll by so many standard deviations and moves points by so many
  /// metres.
  IterationControl::Step step(double deviations, double metres, bool changes_components = false) {
    const IterationControl::Step step = control_.next(!pairs_.rules.selected);
    // Pairs that were just selected from all are to be formed.
    const bool selects = settings_.pair_budget > 0 && (step.all_pairs || !pairs_.rules.selected);
    pairs_.rules.selected = selects || pairs_.rules.selected;
    if (selects) pairs_.moved = HUGE_VAL;
    const SystemVector before = solution_.solution().biases;
    solution_.choice.solution.biases[indexOf(P::boresight_roll)] += deviations;
    if (step.components) {
      EstimatedLevels levels;
      if (changes_components) levels.expected.gauss_markov.position = 3.0;
      control_.recordComponents(VarianceFactors(), levels);
    }
    control_.record(before, {metres, metres, 0.0}, pairs_, solution_);
    if (selects) pairs_.moved = 0.0;
    return step;
  }

  IterationControl& control() { return control_; }
  const ChoiceRules& rules() const { return rules_; }
  PairSet& pairs() { return pairs_; }

 private:
  CalibrationSettings settings_;
  ChoiceRules rules_;
  BlockSolution solution_;
  PairSet pairs_;
  IterationControl control_;
};

TEST(IterationControl, EstimatesComponentsAfterTheGeometryHasConverged) {
  Driven iteration;
  EXPECT_TRUE(iteration.control().isFirst());
  EXPECT_FALSE(iteration.step(100.0, 1.0).ends_coarse);
  EXPECT_TRUE(iteration.control().isCoarse());
  EXPECT_FALSE(iteration.step(10.0, 0.001).ends_coarse);
  // The last movement was small: all pairs are formed, and the components are estimated.
  const IterationControl::Step refined = iteration.step(1.0, 0.1);
  EXPECT_TRUE(refined.ends_coarse && refined.all_pairs && refined.components);
  EXPECT_FALSE(iteration.control().isCoarse());
  EXPECT_FALSE(iteration.control().isConverged());
  // Not after a large movement.
  EXPECT_FALSE(iteration.step(1.0, 0.001).components);
}

TEST(IterationControl, ConvergesWhereNothingChanges) {
  Driven iteration;
  iteration.step(100.0, 1.0);
  iteration.step(1.0, 0.001);
  EXPECT_TRUE(iteration.step(0.01, 1e-5).components);
  EXPECT_FALSE(iteration.control().isConverged());  // of at least four iterations
  iteration.step(0.01, 1e-5);
  EXPECT_TRUE(iteration.control().isConverged());
  EXPECT_FALSE(iteration.continues());
  EXPECT_EQ(iteration.control().iterations().size(), 4U);
}

TEST(IterationControl, DoesNotConvergeWhileComponentsChange) {
  Driven iteration;
  iteration.step(100.0, 1.0);
  iteration.step(1.0, 0.001);
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(iteration.step(0.01, 1e-5, true).components) << i;
    EXPECT_FALSE(iteration.control().isConverged()) << i;
  }
  EXPECT_FALSE(iteration.step(0.01, 1e-5).components);  // eight estimations are enough
  EXPECT_TRUE(iteration.control().isConverged());
}

TEST(IterationControl, DoesNotConvergeWithOutdatedPairs) {
  Driven iteration;
  iteration.step(100.0, 1.0);
  iteration.step(1.0, 0.001);
  iteration.step(0.01, 1e-5);
  iteration.pairs().moved = 1.0;
  iteration.step(0.01, 1e-5);
  EXPECT_FALSE(iteration.control().isConverged());
  iteration.pairs().moved = 0.0;
  iteration.step(0.01, 1e-5);
  EXPECT_TRUE(iteration.control().isConverged());
}

TEST(IterationControl, EndsTheCoarsePhaseAfterTwelveIterations) {
  Driven iteration;
  for (int i = 0; i < 12; ++i) EXPECT_FALSE(iteration.step(100.0, 1.0).ends_coarse) << i;
  EXPECT_TRUE(iteration.step(100.0, 1.0).ends_coarse);
}

TEST(IterationControl, ExcludesTheParameterThatDoesNotConverge) {
  CalibrationSettings settings;
  settings.max_iterations = 5;
  Driven iteration(settings);
  iteration.step(100.0, 1.0);
  iteration.step(1.0, 0.001);
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(iteration.continues());
    EXPECT_TRUE(iteration.rules().excluded.empty());
    iteration.step(1.0, 1.0);
  }
  EXPECT_TRUE(iteration.continues());
  ASSERT_EQ(iteration.rules().excluded.count(P::boresight_roll), 1U);
  EXPECT_NE(iteration.rules().excluded.at(P::boresight_roll).find("does not converge"),
            std::string::npos);
  // What is asked for by name is not excluded.
  settings.estimate = {P::boresight_roll, P::boresight_pitch};
  Driven named(settings);
  named.step(100.0, 1.0);
  named.step(1.0, 0.001);
  for (int i = 0; i < 5; ++i) named.step(1.0, 1.0);
  EXPECT_FALSE(named.continues());
}

TEST(IterationControl, SelectsPairsAgainBeforeItEnds) {
  CalibrationSettings settings;
  settings.pair_budget = 50;
  Driven iteration(settings);
  iteration.step(100.0, 1.0);
  iteration.step(1.0, 0.001);
  EXPECT_TRUE(iteration.step(0.01, 1e-5).all_pairs);   // components are those of all pairs
  EXPECT_FALSE(iteration.step(0.01, 1e-5).all_pairs);  // a negligible update of the selection
  EXPECT_FALSE(iteration.control().isConverged());
  EXPECT_TRUE(iteration.step(0.01, 1e-5).all_pairs);  // the final selection is made from all
  EXPECT_FALSE(iteration.control().isConverged());
  EXPECT_FALSE(iteration.step(0.01, 1e-5).all_pairs);
  EXPECT_TRUE(iteration.control().isConverged());
}

TEST(IterationControl, SaysWhatStillChanges) {
  Driven iteration;
  EXPECT_EQ(iteration.control().reasonNotConverged(
                BlockSolution(SharedErrors({{0.0, 10.0}}, SharedErrorModel()), 1)),
            "no point has a patch in another strip or at control");
}

TEST(IterationMovement, IsThatOfTheGroundBelowTheSensor) {
  PairSet pairs;
  PairObservation o;
  o.lateral = 300.0;
  o.height = 1000.0;
  o.sources[indexOf(ErrorSource::range_scale)] = -800.0;
  pairs.observations = {{o}};
  Corrections before, after;
  before.differences = after.differences = {SystemUnknowns::Zero()};
  after.biases[indexOf(P::lever_arm_x)] = 0.03;
  EXPECT_NEAR(movementOf(pairs, before, after).largest, 0.03, 1e-12);
  EXPECT_NEAR(movementOf(pairs, before, after).effect, 0.03, 1e-12);
  // A range bias moves points along the pulse by as much.
  after.biases.setZero();
  after.biases[indexOf(P::range_bias)] = 0.02;
  EXPECT_NEAR(movementOf(pairs, before, after).largest, 0.02, 1e-12);
  // A turn about the flight direction by the distance from the sensor, sqrt(1000^2 + 300^2) m.
  after.biases.setZero();
  after.biases[indexOf(P::boresight_roll)] = 1e-4;
  EXPECT_NEAR(movementOf(pairs, before, after).largest, 0.1044031, 1e-6);
  // Sources by their effect on distances.
  after.biases.setZero();
  after.sources[indexOf(ErrorSource::range_scale)] = 1e-4;
  EXPECT_NEAR(movementOf(pairs, before, after).largest, 0.08, 1e-12);
}

}  // namespace
}  // namespace pcl_als
