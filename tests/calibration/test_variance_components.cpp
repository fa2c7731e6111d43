// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The variance components of the shared errors: standard deviations that they give where trajectory
// errors are no Gauss-Markov process.
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "adjustment.h"
#include "simulated_observations.h"

namespace pcl_als {
namespace {

/// Four strips of 10 s over control with smooth errors of their height: eight waves of periods from
/// 12 to 100 s. A range bias raises all points; a scale has an effect quadratic in time.
std::vector<AreaObservations> smoothlyWrong(double sigma, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<AreaObservations> areas(4);
  for (int strip = 0; strip < 4; ++strip) {
    double rate[8], cosine[8], sine[8];
    for (int wave = 0; wave < 8; ++wave) {
      rate[wave] = 2.0 * kPi / (12.0 * std::pow(100.0 / 12.0, uniform(random)));
      cosine[wave] = sigma * std::sqrt(0.125) * normal(random);
      sine[wave] = sigma * std::sqrt(0.125) * normal(random);
    }
    for (double time = 0.05; time < 10.0; time += 0.1) {
      PairObservation o;
      o.b = strip, o.time_b = time;
      o.normal = Eigen::Vector3d::UnitZ();
      o.row_b[indexOf(P::range_bias)] = 1.0;
      o.row_b[indexOf(P::scan_angle_scale)] = 300.0 * (std::pow(0.2 * time - 1.0, 2) - 1.0 / 3.0);
      o.variance = 1e-6;
      o.misclosure = 1e-3 * normal(random);
      for (int wave = 0; wave < 8; ++wave)
        o.misclosure -=
            cosine[wave] * std::cos(rate[wave] * time) + sine[wave] * std::sin(rate[wave] * time);
      areas[static_cast<std::size_t>(strip)].push_back(o);
    }
  }
  return areas;
}

TEST(VarianceComponents, CoverSmoothErrors) {
  // The variance of what resembles the scale is known from four strips: Student's t of four degrees
  // of freedom has a standard deviation of 1.41, known to 16 % from 20 values. A Gauss-Markov
  // process alone, its variance determined by changes within a second, gave 2.56.
  SharedErrorModel errors_model = model(20.0);
  errors_model.knot_spacing = 1.0;
  const std::vector<TimeSpan> spans(4, {0.0, 10.0});
  const SharedErrors errors(spans, errors_model);
  const std::vector<P> estimate{P::range_bias, P::scan_angle_scale};
  constexpr int kBlocks = 20;
  double squares = 0.0;
  for (unsigned seed = 1; seed <= kBlocks; ++seed) {
    const auto areas = smoothlyWrong(0.015, seed);
    const auto weights = unitWeights(areas);
    Adjustment adjustment(errors, 1);
    adjustment.accumulate(areas, weights);
    estimateLevels(adjustment, estimate);
    const AdjustmentSolution solution = adjustment.solve(estimate, SystemVector::Zero());
    const int i = indexOf(P::scan_angle_scale);
    squares += std::pow(solution.biases[i], 2) / solution.covariance(i, i);
  }
  const double rms = std::sqrt(squares / kBlocks);
  EXPECT_GT(rms, 0.7);
  EXPECT_LT(rms, 1.8);
}

/// Two strips with all components, shifts of areas included, that some of the data support.
struct AllComponents {
  SharedErrors errors;
  std::vector<AreaObservations> areas = oneAfterAnother(simulated(someBiases(), 0.03, 3));
  std::vector<std::vector<double>> weights = unitWeights(areas);
  Adjustment adjustment{errors, 2};

  explicit AllComponents(double knot_spacing)
      : errors({{0.0, 25.0}, {100.0, 125.0}}, modelWith(knot_spacing)) {
    adjustment.accumulate(areas, weights);
  }
  /// Every area within a part of the strips, so that a sparse factor is sparse.
  static std::vector<AreaObservations> oneAfterAnother(std::vector<AreaObservations> areas) {
    const auto count = static_cast<double>(areas.size());
    for (std::size_t i = 0; i < areas.size(); ++i) {
      const auto place = static_cast<double>(i);
      for (PairObservation& o : areas[i]) {
        for (double* time : {&o.time_a, &o.time_b}) {
          const double start = *time < 50.0 ? 0.0 : 100.0;
          *time = start + (*time - start) / count + 25.0 * place / count;
        }
      }
    }
    return areas;
  }
  static SharedErrorModel modelWith(double knot_spacing) {
    SharedErrorModel errors_model = model(20.0);
    errors_model.knot_spacing = knot_spacing;
    errors_model.local = 0.01;
    return errors_model;
  }
};

using Logarithms = Eigen::Matrix<double, VarianceFactors::kCount, 1>;
VarianceFactors levelsOf(const Logarithms& logarithms) {
  std::array<double, VarianceFactors::kCount> values{};
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = std::exp(logarithms[static_cast<Eigen::Index>(k)]);
  return VarianceFactors::of(values);
}

/// With a dense factor (few knots) and a sparse one.
class Likelihood : public testing::TestWithParam<double> {};

TEST_P(Likelihood, GradientEqualsCentralDifferences) {
  // A central difference over 2e-3 is wrong by the third derivative times 2e-7, and by the rounding
  // of a deviance of about 1e4, 1e-11 of it, over the step.
  const AllComponents block(GetParam());
  Logarithms at;
  at << 0.3, -1.0, 0.2, 0.1, -0.4, 0.8, -2.0, 0.5, 0.1, -0.3;
  const auto likelihood = block.adjustment.restrictedLikelihood(levelsOf(at), kSix);
  constexpr double kStep = 1e-3;
  for (int k = 0; k < VarianceFactors::kCount; ++k) {
    Logarithms more = at, less = at;
    more[k] += kStep;
    less[k] -= kStep;
    const double difference = block.adjustment.restrictedLikelihood(levelsOf(more), kSix).deviance -
                              block.adjustment.restrictedLikelihood(levelsOf(less), kSix).deviance;
    EXPECT_NEAR(likelihood.gradient[k], difference / (2.0 * kStep), 1e-4) << "component " << k;
  }
}

TEST_P(Likelihood, InformationIsThatOfTheQuadraticForm) {
  // The part of the deviance that depends on the observations, y'P(v)y, has the second derivatives
  // 2 y'P V_k P V_l P y, twice the average information over the components. It follows from
  // observations scaled by two factors, because the determinants do not depend on them.
  AllComponents block(GetParam());
  const auto deviance = [&](double factor, const Logarithms& at) {
    auto areas = block.areas;
    for (AreaObservations& area : areas) {
      for (PairObservation& o : area) o.misclosure *= factor;
    }
    Adjustment adjustment(block.errors, 2);
    adjustment.accumulate(areas, block.weights);
    return adjustment.restrictedLikelihood(levelsOf(at), kSix).deviance;
  };
  const auto quadratic = [&](const Logarithms& at) {
    return (deviance(2.0, at) - deviance(1.0, at)) / 3.0;
  };
  const Logarithms at = Logarithms::Constant(0.2);
  const auto information = block.adjustment.restrictedLikelihood(levelsOf(at), kSix).information;
  constexpr double kStep = 0.02;
  for (const auto& [k, l] : {std::pair(0, 3), std::pair(9, 9), std::pair(1, 9)}) {
    double second = 0.0, first = 0.0;
    for (const double a : {-kStep, kStep}) {
      for (const double b : {-kStep, kStep}) {
        Logarithms there = at;
        there[k] += a;
        there[l] += b;
        second += (a * b > 0.0 ? 1.0 : -1.0) * quadratic(there) / (4.0 * kStep * kStep);
      }
      Logarithms there = at;
      there[k] += a;
      first += (a > 0.0 ? 1.0 : -1.0) * quadratic(there) / (2.0 * kStep);
    }
    // v_k v_l times the derivatives with respect to v, from those with respect to ln v.
    const double wanted = 0.5 * (second - (k == l ? first : 0.0));
    EXPECT_NEAR(information(k, l), wanted, 2e-3 * std::abs(wanted) + 2e-3) << k << " " << l;
  }
}

INSTANTIATE_TEST_SUITE_P(Factors, Likelihood, testing::Values(1.0, 0.199));

TEST(VarianceComponents, AreNearTheMostLikely) {
  // With the prior of the components. A standard deviation s of a component changes -2 ln of the
  // likelihood by one. The expectation is s^2 / 2 above the most likely logarithm, which changes it
  // by s^2 / 4, at most by 0.125; the search leaves steps of 0.01 each.
  AllComponents block(1.0);
  const VarianceFactors best = estimateLevels(block.adjustment, kSix).expected;
  const auto cost = [&](const std::array<double, VarianceFactors::kCount>& values) {
    const VarianceFactors levels = VarianceFactors::of(values);
    double sum = block.adjustment.restrictedLikelihood(levels, kSix).deviance;
    for (std::size_t k = 0; k < values.size(); ++k) {
      // Of position, roll and pitch, heading, the last is expected to be as that of roll and pitch.
      const double expected = k % 3 == 2 ? values[k - 1] : 1.0;
      sum += 2.0 * std::log1p(std::pow(std::log(values[k] / expected), 2));
    }
    return sum;
  };
  const double lowest = cost(best.values());
  for (std::size_t k = 0; k < VarianceFactors::kCount; ++k) {
    for (const double factor : {1.0 / 1.2, 1.2}) {
      auto values = best.values();
      values[k] *= factor;
      EXPECT_GT(cost(values), lowest - 0.2) << "component " << k;
    }
  }
}

/// The variances of the model are what is expected where observations have hardly any weight.
TEST(VarianceComponents, UndeterminedOnesAreThoseOfTheModel) {
  AllComponents block(1.0);
  auto weights = block.weights;
  for (auto& area : weights) std::fill(area.begin(), area.end(), 1e-7);
  block.adjustment.accumulate(block.areas, weights);
  const auto values = estimateLevels(block.adjustment, kSix, {}, 1e-9).expected.values();
  for (const double value : values) EXPECT_NEAR(value, 1.0, 0.01);
}

/// Variance over that of the model of the sum of the components of an error.
double sumOf(const VarianceFactors& levels, double VarianceFactors::Trajectory::*kind) {
  const SharedErrorModel shares;
  return shares.constant_share * levels.constant.*kind + shares.smooth_share * levels.smooth.*kind +
         (1.0 - shares.constant_share - shares.smooth_share) * levels.gauss_markov.*kind;
}

/// The components that four strips with errors of the roll give; observations 300 m to both sides
/// of the flight lines, which do not show errors of the heading.
VarianceFactors levelsOfRoll(double roll_arcsec) {
  constexpr double kAcrossTrack = 300.0;  // metres from the flight line, to either side
  std::vector<AreaObservations> areas =
      smoothlyWrong(kAcrossTrack * roll_arcsec * kRadiansPerArcsec, 5);
  for (AreaObservations& area : areas) {
    AreaObservations both;
    for (PairObservation o : area) {
      o.row_b[indexOf(P::scan_angle_scale)] = 0.0;
      o.row_b[indexOf(P::boresight_roll)] = kAcrossTrack;
      both.push_back(o);
      o.row_b[indexOf(P::boresight_roll)] = -kAcrossTrack;
      o.misclosure = -o.misclosure;
      both.push_back(o);
    }
    area = both;
  }
  SharedErrorModel errors_model = model(20.0);
  errors_model.knot_spacing = 1.0;
  const SharedErrors errors(std::vector<TimeSpan>(4, {0.0, 10.0}), errors_model);
  Adjustment adjustment(errors, 1);
  adjustment.accumulate(areas, unitWeights(areas));
  return estimateLevels(adjustment, {P::range_bias, P::boresight_roll}).expected;
}

/// 2026-11: a roll of ten times the standard deviation of the model (a drone without -ins) was
/// limited to four times, and boresight_roll 8 standard deviations wrong. The heading, which these
/// observations do not show, is as much worse a priori.
TEST(VarianceComponents, AttitudeOfAnotherGradeIsFound) {
  const VarianceFactors found = levelsOfRoll(80.0);
  // Four strips: a variance is known to a factor of three.
  EXPECT_GT(sumOf(found, &VarianceFactors::Trajectory::roll_pitch), 30.0);
  EXPECT_LT(sumOf(found, &VarianceFactors::Trajectory::roll_pitch), 300.0);
  EXPECT_GT(sumOf(found, &VarianceFactors::Trajectory::heading), 10.0);
  EXPECT_LT(sumOf(found, &VarianceFactors::Trajectory::position), 16.1);
}

/// Errors of the roll far below the model: those of the heading were expected to be as large as the
/// model's, and the standard deviation of the boresight heading was three times too large.
TEST(VarianceComponents, AttitudeOfABetterGradeIsFound) {
  const VarianceFactors found = levelsOfRoll(0.08);
  EXPECT_LT(sumOf(found, &VarianceFactors::Trajectory::roll_pitch), 0.03);
  EXPECT_LT(sumOf(found, &VarianceFactors::Trajectory::heading), 0.05);
}

}  // namespace
}  // namespace pcl_als
