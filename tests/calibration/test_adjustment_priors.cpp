// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// What an adjustment makes of prior information: of parameters, and of error sources.
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "adjustment.h"
#include "chosen_parameters.h"
#include "parameter_choice.h"
#include "prior_comparison.h"
#include "simulated_observations.h"

namespace pcl_als {
namespace {

/// A prior of a parameter acts like one more observation of it.
TEST(Adjustment, PriorsOfParametersAreObservations) {
  const auto areas = simulated(someBiases(), 0.02, 3);
  const auto weights = unitWeights(areas);
  const auto solved = [&](const SharedErrorModel& errors_model) {
    const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, errors_model);
    Adjustment adjustment(errors);
    adjustment.accumulate(areas, weights);
    return adjustment.solve(kSix, SystemVector::Zero());
  };
  const AdjustmentSolution without = solved(model());
  const int roll = indexOf(P::boresight_roll);
  SharedErrorModel known = model();
  const double std = std::sqrt(without.covariance(roll, roll));
  known.biases.information(roll, roll) = 1.0 / (std * std);
  known.biases.mean[roll] = without.biases[roll] + std;
  const AdjustmentSolution with = solved(known);
  // Two values of about equal weight: the mean, with a standard deviation smaller by the root of 2.
  // The standard deviation without the prior may be that of the jackknife, larger than the model's.
  EXPECT_GT(with.biases[roll], without.biases[roll] + 0.1 * std);
  EXPECT_LT(with.biases[roll], without.biases[roll] + 0.55 * std);
  EXPECT_LT(with.covariance(roll, roll), 0.9 * without.covariance(roll, roll));
  known.biases.information(roll, roll) = 1e20;
  EXPECT_NEAR(solved(known).biases[roll], known.biases.mean[roll], 1e-6 * std);
}

/// The solution with a prior of correlated parameters is that of the equations without it and of
/// direct observations of the parameters with the covariance of the prior.
TEST(Adjustment, PriorsWithCorrelationsAreObservationsWithThem) {
  const auto areas = simulated(someBiases(), 0.02, 3);
  const auto solvedWith = [&](const BiasPrior& prior, Eigen::MatrixXd* normal = nullptr,
                              Eigen::VectorXd* right = nullptr) {
    SharedErrorModel known = model();
    known.biases = prior;
    const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, known);
    Adjustment adjustment(errors);
    adjustment.accumulate(areas, unitWeights(areas));
    if (normal != nullptr) {
      *normal = sub(adjustment.normalOf(kSix), kSix);
      *right = Eigen::VectorXd(6);
      for (int i = 0; i < 6; ++i)
        (*right)[i] = adjustment.rightOf(kSix)[indexOf(kSix[static_cast<std::size_t>(i)])];
    }
    return adjustment.solve(kSix, SystemVector::Zero());
  };
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  const AdjustmentSolution without = solvedWith({}, &normal, &right);
  // Standard deviations as those of the solution, correlations of -0.6 and 0.3.
  Eigen::MatrixXd covariance(3, 3);
  const std::vector<P> order{P::lever_arm_y, P::boresight_pitch, P::scan_angle_scale};
  Eigen::Vector3d std;
  SystemVector mean = SystemVector::Zero();
  for (int i = 0; i < 3; ++i) {
    const int at = indexOf(order[static_cast<std::size_t>(i)]);
    std[i] = std::sqrt(without.model(at, at));
    mean[at] = without.biases[at] + (i - 1.5) * std[i];
  }
  covariance << 1.0, -0.6, 0.3, -0.6, 1.0, 0.0, 0.3, 0.0, 1.0;
  covariance = (std.asDiagonal() * covariance * std.asDiagonal()).eval();
  const AdjustmentSolution with = solvedWith(biasPrior(order, mean, covariance));
  // Rows of Cholesky factors: the equations, and observations that the inverse factor decorrelates.
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(9, 6);
  Eigen::VectorXd values(9);
  const Eigen::MatrixXd upper = normal.llt().matrixU();
  rows.topRows(6) = upper;
  values.head(6) = upper.transpose().triangularView<Eigen::Lower>().solve(right);
  const Eigen::MatrixXd lower = covariance.llt().matrixL();
  const Eigen::MatrixXd decorrelate = lower.inverse();
  const int columns[3] = {1, 2, 5};  // of the order in kSix
  Eigen::Vector3d means;
  for (int i = 0; i < 3; ++i) {
    rows.block(6, columns[i], 3, 1) = decorrelate.col(i);
    means[i] = mean[indexOf(order[static_cast<std::size_t>(i)])];
  }
  values.tail(3) = decorrelate * means;
  const Eigen::VectorXd expected = rows.colPivHouseholderQr().solve(values);
  for (int i = 0; i < 6; ++i) {
    const int at = indexOf(kSix[static_cast<std::size_t>(i)]);
    EXPECT_NEAR(with.biases[at], expected[i], 1e-9 * std::sqrt(without.model(at, at))) << i;
    EXPECT_GT(std::abs(with.biases[at] - without.biases[at]), 0.0);
  }
  const Eigen::MatrixXd posterior = (rows.transpose() * rows).inverse();
  for (int i = 0; i < 6; ++i) {
    const int at = indexOf(kSix[static_cast<std::size_t>(i)]);
    EXPECT_NEAR(with.model(at, at), posterior(i, i), 1e-9 * posterior(i, i)) << i;
  }
}

/// Of parameters that are held, at a value that the prior does not expect, it says nothing.
TEST(Adjustment, PriorsOfHeldParametersHaveNoEffect) {
  const auto areas = simulated(someBiases(), 0.02, 3);
  const auto rollWith = [&](const BiasPrior& prior) {
    SharedErrorModel known = model();
    known.biases = prior;
    const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, known);
    Adjustment adjustment(errors);
    adjustment.accumulate(areas, unitWeights(areas));
    return adjustment.solve({P::boresight_roll}, SystemVector::Zero());
  };
  const int roll = indexOf(P::boresight_roll), arm = indexOf(P::lever_arm_x);
  Eigen::Matrix2d covariance;
  covariance << 1e-10, 0.9e-5 * 0.1, 0.9e-5 * 0.1, 0.01;
  SystemVector mean = SystemVector::Zero();
  mean[roll] = 3e-4, mean[arm] = 0.5;
  BiasPrior alone;
  alone.add(P::boresight_roll, 3e-4, 1e-5);
  const AdjustmentSolution both =
      rollWith(biasPrior({P::boresight_roll, P::lever_arm_x}, mean, covariance));
  const AdjustmentSolution one = rollWith(alone);
  EXPECT_NEAR(both.biases[roll], one.biases[roll], 1e-9 * std::abs(one.biases[roll]));
  EXPECT_NEAR(both.covariance(roll, roll), one.covariance(roll, roll),
              1e-9 * one.covariance(roll, roll));
  EXPECT_GT(std::abs(one.biases[roll] - rollWith({}).biases[roll]), 1e-8);
}

/// What is recorded of a held parameter is the derivative of the solution by its value.
TEST(ParameterChoice, RecordsTheEffectOfHeldParameters) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  const auto areas = simulated(someBiases(), 0.02, 3);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, unitWeights(areas));
  const DeterminationLimits limits;
  const ParameterChoice choice =
      chooseParameters(adjustment, kSix, SystemVector::Zero(), limits, 1e6, {P::range_bias});
  ASSERT_EQ(choice.held.parameters, std::vector<P>{P::range_bias});
  EXPECT_EQ(choice.held.std.front(), limits.whenHeld(P::range_bias));
  SystemVector held = SystemVector::Zero();
  held[indexOf(P::range_bias)] = 0.01;
  const SystemVector moved = adjustment.solve(kSix, held).biases - choice.solution.biases;
  for (std::size_t i = 0; i < kSix.size(); ++i)
    EXPECT_NEAR(choice.held.effect(static_cast<Eigen::Index>(i), 0), moved[indexOf(kSix[i])] / 0.01,
                1e-6 * std::abs(moved[indexOf(kSix[i])] / 0.01) + 1e-15)
        << i;
}

/// Two values of equal weight: half of the variance stems from each; and a prior 10 standard
/// deviations from what the flight says is a significant difference, of the right size.
TEST(PriorDifferences, AreThoseOfFlightAndPrior) {
  const auto areas = simulated(someBiases(), 0.02, 3);
  const std::vector<P> roll_only{P::boresight_roll};
  const int roll = indexOf(P::boresight_roll);
  const auto chosenWith = [&](const BiasPrior& prior) {
    SharedErrorModel known = model();
    known.biases = prior;
    const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, known);
    Adjustment adjustment(errors);
    adjustment.accumulate(areas, unitWeights(areas));
    return chooseParameters(adjustment, roll_only, SystemVector::Zero(), {}, 1.0);
  };
  const AdjustmentSolution alone = chosenWith({}).solution;
  const double std = std::sqrt(alone.model(roll, roll));
  for (const double shift : {0.5, -10.0}) {
    BiasPrior prior;
    prior.add(P::boresight_roll, alone.biases[roll] - shift * std, std);
    const ParameterChoice choice = chosenWith(prior);
    const std::vector<PriorDifference> found = priorDifferences(prior, choice);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].flight, alone.biases[roll], 1e-6 * std);
    EXPECT_NEAR(found[0].change, shift * std, 1e-6 * std);
    EXPECT_GE(found[0].change_std, 1.414 * std);
    EXPECT_LT(found[0].change_std, 2.0 * std);
    EXPECT_EQ(found[0].significant, std::abs(shift) > 5.0);
    CalibrationResult result;
    reportPrior(prior, choice, {}, result);
    EXPECT_NEAR(result[P::boresight_roll].prior_share, 0.5, 1e-6);
    EXPECT_EQ(result.warnings.size(), found[0].significant ? 1U : 0U);
  }
}

/// Observations with an error source: it is found with its size, and no other one is.
TEST(Adjustment, FindsTheErrorSourceThatIsPresent) {
  for (const ErrorSourceInfo& info : errorSources()) {
    SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
    std::vector<ErrorSource> all;
    for (const ErrorSourceInfo& source : errorSources()) all.push_back(source.source);
    errors.considerSources(all);
    auto areas = simulated(someBiases(), 0.02, 5);
    std::mt19937_64 random(6);
    std::normal_distribution<double> normal;
    const double value = 0.5 * errors.model().sources[indexOf(info.source)].std;
    for (AreaObservations& area : areas) {
      for (PairObservation& o : area) {
        // Effects of 5 cm for one prior standard deviation.
        for (const ErrorSource source : all)
          o.sources[indexOf(source)] = static_cast<float>(
              0.05 * normal(random) / errors.model().sources[indexOf(source)].std);
        o.misclosure += value * o.sources[indexOf(info.source)];
      }
    }
    const auto weights = unitWeights(areas);
    Adjustment adjustment(errors);
    adjustment.accumulate(areas, weights);
    const AdjustmentSolution solution = adjustment.solve(kSix, SystemVector::Zero());
    for (const ErrorSource source : all) {
      const int i = indexOf(source);
      if (source == info.source) {
        EXPECT_GT(solution.source_probability[i], 0.99) << info.name;
        EXPECT_NEAR(solution.source_value[i], value, 4.0 * solution.source_std[i]) << info.name;
      } else {
        EXPECT_LT(solution.source_probability[i], 0.5) << info.name << ' ' << infoOf(source).name;
      }
    }
  }
}

/// The derivative by a source that is held agrees with solutions for which it is held at two
/// values.
TEST(Adjustment, DerivativeBySourceIsThatOfTheSolution) {
  const ErrorSource source = ErrorSource::time_offset;
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  auto areas = simulated(someBiases(), 0.02, 7);
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  for (AreaObservations& area : areas)
    for (PairObservation& o : area)
      o.sources[indexOf(source)] = static_cast<float>(60.0 + 20.0 * normal(random));
  const auto weights = unitWeights(areas);
  const auto solvedAt = [&](double value, SystemVector* derivative = nullptr) {
    auto held = areas;
    for (AreaObservations& area : held)
      for (PairObservation& o : area) o.misclosure -= value * o.sources[indexOf(source)];
    Adjustment adjustment(errors);
    adjustment.accumulate(held, weights);
    if (derivative != nullptr) *derivative = adjustment.derivativeBySource(source, kSix);
    return adjustment.solve(kSix, SystemVector::Zero()).biases;
  };
  SystemVector derivative;
  const double step = 1e-4;
  const SystemVector before = solvedAt(-step, &derivative), after = solvedAt(step);
  const SystemVector difference = (after - before) / (2.0 * step);
  ASSERT_GT(derivative.norm(), 0.0);
  for (int i = 0; i < kSystemParameterCount; ++i)
    EXPECT_NEAR(derivative[i], difference[i], 1e-3 * std::abs(difference[i]) + 1e-12) << i;
}

TEST(SharedErrorModel, SourcesAreDeterminedWhereSmallOrDifferentFromZero) {
  EXPECT_TRUE(SharedErrorModel::isDetermined(0.0, 0.24, 1.0));
  EXPECT_FALSE(SharedErrorModel::isDetermined(0.0, 0.26, 1.0));
  EXPECT_FALSE(SharedErrorModel::isDetermined(-1.4, 0.4, 1.0));
  EXPECT_TRUE(SharedErrorModel::isDetermined(-1.7, 0.4, 1.0));
}

TEST(SharedErrorModel, ShortBlocksHaveKnotsCloserTogether) {
  using Spans = std::vector<std::vector<TimeSpan>>;
  const SharedErrorModel errors;
  const auto spacingFor = [&](const Spans& spans) {
    return withKnotsFor(errors, spans).knot_spacing;
  };
  EXPECT_EQ(spacingFor({}), 0.4);
  EXPECT_EQ(spacingFor({{{0.0, 30.0}}, {{100.0, 115.0}}}), 0.4);
  // Overlapping spans of two areas count once: 60 + 30 s.
  EXPECT_NEAR(spacingFor({{{20.0, 60.0}, {0.0, 50.0}}, {{100.0, 130.0}}}), 0.6, 1e-12);
  EXPECT_EQ(spacingFor({{{0.0, 3600.0}}}), 1.0);
  SharedErrorModel close = errors;
  close.knot_spacing = 0.2;
  EXPECT_EQ(withKnotsFor(close, {{{0.0, 3600.0}}}).knot_spacing, 0.2);
}

TEST(SharedErrorModel, GradesOfInertialSystems) {
  // 0.025 and 0.08 degrees of the data sheet of a drone's system.
  const SharedErrorModel mems = SharedErrorModel::ofGrade("mems");
  EXPECT_NEAR(mems.roll_pitch, 0.025 * kRadiansPerDegree, 1e-12);
  EXPECT_NEAR(mems.heading, 0.08 * kRadiansPerDegree, 1e-12);
  EXPECT_EQ(mems.correlation_time, SharedErrorModel().correlation_time);
  EXPECT_LT(SharedErrorModel::ofGrade("survey").heading,
            SharedErrorModel::ofGrade("tactical").heading);
  EXPECT_THROW(SharedErrorModel::ofGrade("good"), UsageError);
}

}  // namespace
}  // namespace pcl_als
