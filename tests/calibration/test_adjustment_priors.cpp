// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// What an adjustment makes of prior information: of parameters, and of error sources.
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "adjustment.h"
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
  known.biases.information[roll] = 1.0 / (std * std);
  known.biases.mean[roll] = without.biases[roll] + std;
  const AdjustmentSolution with = solved(known);
  // Two values of about equal weight: the mean, with a standard deviation smaller by the root of 2.
  // The standard deviation without the prior may be that of the jackknife, larger than the model's.
  EXPECT_GT(with.biases[roll], without.biases[roll] + 0.1 * std);
  EXPECT_LT(with.biases[roll], without.biases[roll] + 0.55 * std);
  EXPECT_LT(with.covariance(roll, roll), 0.9 * without.covariance(roll, roll));
  known.biases.information[roll] = 1e20;
  EXPECT_NEAR(solved(known).biases[roll], known.biases.mean[roll], 1e-6 * std);
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
