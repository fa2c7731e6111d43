// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "adjustment.h"
#include "simulated_observations.h"

namespace pcl_als {
namespace {

/// Correlation of the smooth component at two times, by the sum over the B-splines of all nodes.
double smoothCorrelation(double a, double b, double node_spacing) {
  const auto spline = [](double x) {  // by the definition with truncated powers
    double sum = 0.0;
    const double binomial[] = {1.0, -4.0, 6.0, -4.0, 1.0};
    for (int k = 0; k <= 4; ++k) sum += binomial[k] * std::pow(std::max(0.0, x + 2.0 - k), 3);
    return sum / 6.0;
  };
  double sum = 0.0;
  for (int node = -10; node < 30; ++node)
    sum += spline(a / node_spacing - node) * spline(b / node_spacing - node);
  return sum / (151.0 / 315.0);  // mean square of the spline: variance one on average
}

TEST(SharedErrors, PriorIsTheSumOfItsComponents) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 105.0}}, model());
  ASSERT_EQ(errors.knotCount(), 4 + 2);  // 25 s at 10 s: three steps of 8.33 s; 5 s: one step
  VarianceFactors levels;
  levels.constant.position = 0.5, levels.smooth.position = 3.0, levels.gauss_markov.heading = 4.0;
  const Eigen::MatrixXd covariance = Eigen::MatrixXd(errors.priorInformation(levels)).inverse();
  const double step = 25.0 / 3.0, node = 7.5;  // a quarter of the correlation time of 30 s
  const auto expected = [&](int i, int j) {    // knots, east; 2 cm
    return 4e-4 * (0.2 * 0.5 + 0.4 * 3.0 * smoothCorrelation(i * step, j * step, node) +
                   0.4 * std::exp(-std::abs(i - j) * step / 30.0));
  };
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(covariance(6 * i, 6 * j), expected(i, j), 1e-14);
  }
  EXPECT_NEAR(covariance(0, 24), 0.0, 1e-18);  // another strip
  const double heading = 0.2 + 0.4 * smoothCorrelation(0.0, 0.0, node) + 0.4 * 4.0;
  EXPECT_NEAR(covariance(5, 5), std::pow(16.0 * kRadiansPerArcsec, 2) * heading, 1e-20);
  EXPECT_NEAR(errors.variances(levels)[0], 4e-4 * (0.2 * 0.5 + 0.4 * 3.0 + 0.4), 1e-18);
}

TEST(SharedErrors, PriorDeterminantIsThatOfItsInformation) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 100.0}}, model(), {{{3.0, 9.0}}, {}});
  VarianceFactors levels;
  levels.constant.heading = 0.5, levels.smooth.roll_pitch = 3.0, levels.gauss_markov.position = 4.0;
  const Eigen::MatrixXd information = errors.priorInformation(levels);
  EXPECT_NEAR(errors.priorLogDeterminant(levels), information.ldlt().vectorD().array().log().sum(),
              1e-8);
}

TEST(SharedErrors, PlacesTimesBetweenKnots) {
  const SharedErrors errors({{0.0, 20.0}, {50.0, 50.0}}, model());
  const auto inside = errors.placeOf(0, 12.5);
  EXPECT_EQ(inside.knot, 1);
  EXPECT_EQ(inside.next_knot, 2);
  EXPECT_DOUBLE_EQ(inside.next, 0.25);
  EXPECT_DOUBLE_EQ(errors.placeOf(0, 99.0).next, 1.0);  // clamped
  EXPECT_EQ(errors.placeOf(1, 50.0).knot, errors.placeOf(1, 50.0).next_knot);
}

TEST(SharedErrors, BridgesWhatNobodyObserves) {
  // Knots at 0, 10, ... 100 s; observed from 0 to 5 s and at 72 s: those at 0, 10, 70, 80 remain,
  // with the covariance that the whole chain gives them.
  const SharedErrors whole({{0.0, 100.0}}, model());
  const SharedErrors part({{0.0, 100.0}}, model(), {{{72.0, 72.0}, {0.0, 5.0}}});
  ASSERT_EQ(whole.knotCount(), 11);
  ASSERT_EQ(part.knotCount(), 4);
  const Eigen::MatrixXd all = Eigen::MatrixXd(whole.priorInformation()).inverse();
  const Eigen::MatrixXd kept = Eigen::MatrixXd(part.priorInformation()).inverse();
  const int steps[] = {0, 1, 7, 8};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j)
      EXPECT_NEAR(kept(6 * i, 6 * j), all(6 * steps[i], 6 * steps[j]), 1e-15);
  }
  EXPECT_EQ(part.placeOf(0, 75.0).knot, 2);
  EXPECT_DOUBLE_EQ(part.placeOf(0, 75.0).next, 0.5);
}

TEST(SharedErrors, ExpectsOfUnobservedTimesWhatTheProcessDoes) {
  const SharedErrors whole({{0.0, 100.0}}, model());
  const SharedErrors part({{0.0, 100.0}}, model(), {{{72.0, 72.0}, {0.0, 5.0}}});
  Eigen::VectorXd known = Eigen::VectorXd::Zero(part.unknowns());
  for (int knot = 0; knot < 4; ++knot) known[6 * knot] = 0.01 * (knot + 1);
  // The other knots of the whole chain, given those: -(N_oo)^-1 N_ok x_k.
  const Eigen::MatrixXd information = Eigen::MatrixXd(whole.priorInformation());
  const std::vector<int> given{0, 1, 7, 8}, open{2, 3, 4, 5, 6, 9, 10};
  Eigen::MatrixXd oo(7, 7), ok(7, 4);
  for (int r = 0; r < 7; ++r) {
    for (int c = 0; c < 7; ++c) oo(r, c) = information(6 * open[r], 6 * open[c]);
    for (int c = 0; c < 4; ++c) ok(r, c) = information(6 * open[r], 6 * given[c]);
  }
  const Eigen::VectorXd expected = -oo.ldlt().solve(ok * Eigen::Vector4d(0.01, 0.02, 0.03, 0.04));
  const auto errors = part.errorsOf(0, known);
  ASSERT_EQ(errors.size(), 11U);
  EXPECT_DOUBLE_EQ(errors[7].position.x(), 0.03);
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(errors[open[i]].position.x(), expected[i], 1e-15);
}

TEST(SharedErrors, ExpectsOfUnobservedTimesWhatAllComponentsDo) {
  // The best prediction from the errors at the knots: with coefficients as the knots let expect
  // them, those between are C_ok C_kk^-1 x_k of the whole chain.
  const SharedErrors whole({{0.0, 100.0}}, model());
  const SharedErrors part({{0.0, 100.0}}, model(), {{{72.0, 72.0}, {0.0, 5.0}}});
  const Eigen::MatrixXd all = Eigen::MatrixXd(whole.priorInformation()).inverse();
  const Eigen::MatrixXd kept = Eigen::MatrixXd(part.priorInformation()).inverse();
  const Eigen::Vector4d values(0.01, 0.02, -0.03, 0.04);
  Eigen::Matrix4d among;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) among(i, j) = kept(6 * i, 6 * j);
  }
  const Eigen::Vector4d weights = among.ldlt().solve(values);
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(part.unknowns());
  for (int k = 0; k < part.unknowns(); k += 6) {
    for (int i = 0; i < 4; ++i) solution[k] += kept(k, 6 * i) * weights[i];
  }
  const auto errors = part.errorsOf(0, solution);
  ASSERT_EQ(errors.size(), 11U);
  const int steps[] = {0, 1, 7, 8};
  for (int step = 0; step <= 10; ++step) {
    double expected = 0.0;
    for (int i = 0; i < 4; ++i) expected += all(6 * step, 6 * steps[i]) * weights[i];
    EXPECT_NEAR(errors[step].position.x(), expected, 1e-12) << step;
  }
}

TEST(SharedErrors, RefusesAnImpossibleModel) {
  SharedErrorModel errors;
  errors.heading = 0.0;
  EXPECT_THROW(errors.validate(), UsageError);
}

TEST(Adjustment, RecoversBiasesFromExactObservations) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  const auto areas = simulated(someBiases(), 0.0, 1);
  const auto weights = unitWeights(areas);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, weights);
  const AdjustmentSolution solution = adjustment.solve(kSix, SystemVector::Zero());
  ASSERT_TRUE(solution.solved);
  for (int i = 0; i < kSystemParameterCount; ++i)
    EXPECT_NEAR(solution.biases[i], someBiases()[i], 1e-10);
  EXPECT_LT(std::abs(adjustment.residual(areas[3][7], solution)), 1e-9);
}

/// All unknowns in one dense normal matrix: what the elimination must be equal to. Without its
/// ranging share, if so wished.
struct DenseSystem {
  Eigen::VectorXd solution;  ///< eight parameters, then the shared errors
  Eigen::MatrixXd covariance;
  double deviance = 0.0;  ///< -2 ln of the likelihood, whatever the parameters are

  DenseSystem(const SharedErrors& errors, const std::vector<AreaObservations>& areas,
              bool ranging) {
    const int unknowns = 8 + errors.unknowns(), instrument = 8 + 6 * errors.instrumentBlock();
    const Eigen::MatrixXd prior = errors.priorInformation();
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    normal.bottomRightCorner(errors.unknowns(), errors.unknowns()) = prior;
    for (const AreaObservations& area : areas) {
      for (const PairObservation& o : area) {
        Eigen::VectorXd row = Eigen::VectorXd::Zero(unknowns);
        row.head<8>() = o.row().transpose();
        const auto place = [&](int strip, double time, const SystemRow& design, double sign) {
          const auto where = errors.placeOf(strip, time);
          Eigen::Matrix<double, 6, 1> effect;
          effect << o.normal, design.segment<3>(3).transpose();
          row.segment<6>(8 + 6 * where.knot) += sign * (1.0 - where.next) * effect;
          row.segment<6>(8 + 6 * where.next_knot) += sign * where.next * effect;
        };
        place(o.a, o.time_a, o.row_a.cast<double>(), 1.0);
        if (!o.hasMixedTimes()) place(o.b, o.time_b, o.row_b.cast<double>(), -1.0);
        if (o.hasMixedTimes())
          for (const PairObservation::Special::Vertex& vertex : o.special->vertices) {
            SystemRow turn = SystemRow::Zero();
            turn.segment<3>(3) = vertex.turn.cast<double>();
            place(o.b, vertex.time, turn, -double{vertex.weight});
          }
        row[instrument] = ranging ? o.sources[indexOf(ErrorSource::slope_ranging)] : 0.0;
        normal += row * row.transpose() / o.variance;
        right += row * o.misclosure / o.variance;
      }
    }
    double held = 0.0;
    for (const P fixed : {P::lever_arm_z, P::range_bias}) {
      normal(indexOf(fixed), indexOf(fixed)) += 1e20;
      held += std::log(normal(indexOf(fixed), indexOf(fixed)));
    }
    const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    covariance = scale.asDiagonal() * scaled.inverse() * scale.asDiagonal();
    solution = covariance * right;
    deviance = scaled.ldlt().vectorD().array().log().sum() - 2.0 * scale.array().log().sum() -
               held - prior.ldlt().vectorD().array().log().sum() - right.dot(solution);
  }
};

TEST(Adjustment, EqualsTheDenseSolution) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  const auto areas = simulated(someBiases(), 0.02, 2);
  const auto weights = unitWeights(areas);
  const DenseSystem dense(errors, areas, true);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, weights);
  const AdjustmentSolution solution = adjustment.solve(kSix, SystemVector::Zero());
  for (const P p : kSix) {
    const int i = indexOf(p);
    const double std = std::sqrt(dense.covariance(i, i));
    EXPECT_NEAR(solution.biases[i], dense.solution[i], 1e-6 * std);  // rounding of two routes
    EXPECT_GE(std::sqrt(solution.covariance(i, i)), std * (1.0 - 1e-6));
    EXPECT_LT(std::sqrt(solution.formal(i, i)), std);
  }
  const Eigen::VectorXd shared = dense.solution.tail(errors.unknowns());
  EXPECT_LT((solution.shared - shared).norm(), 1e-6 * shared.norm());
}

/// Patches of vertices that were measured up to 20 s apart, among others that were not.
TEST(Adjustment, EqualsTheDenseSolutionForPatchesOfMixedTimes) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  auto areas = simulated(someBiases(), 0.02, 5);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform;
  for (AreaObservations& area : areas) {
    for (std::size_t i = 0; i < area.size(); i += 3) {
      PairObservation& o = area[i];
      PairObservation::Special special;
      special.mixed_times = true;
      const float first = static_cast<float>(uniform(random)),
                  second = static_cast<float>(uniform(random)) * (1.0F - first);
      const float weights[3] = {first, second, 1.0F - first - second};
      for (int k = 0; k < 3; ++k) {
        special.vertices[k].time = o.time_b + 20.0 * (uniform(random) - 0.5);
        special.vertices[k].weight = weights[k];
        for (int axis = 0; axis < 3; ++axis)
          special.vertices[k].turn[axis] = static_cast<float>(300.0 * (uniform(random) - 0.5));
      }
      o.special = std::make_shared<const PairObservation::Special>(special);
    }
  }
  const DenseSystem dense(errors, areas, true);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, unitWeights(areas));
  const AdjustmentSolution solution = adjustment.solve(kSix, SystemVector::Zero());
  for (const P p : kSix) {
    const int i = indexOf(p);
    EXPECT_NEAR(solution.biases[i], dense.solution[i],
                1e-6 * std::sqrt(dense.covariance(i, i)));  // rounding of two routes
  }
  const Eigen::VectorXd shared = dense.solution.tail(errors.unknowns());
  EXPECT_LT((solution.shared - shared).norm(), 1e-6 * shared.norm());
}

/// An instrument with and one without a ranging error on slopes, each solved for on its own and
/// weighed by how likely it makes the observations.
TEST(Adjustment, BelievesInARangingErrorAsFarAsItIsSeen) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  for (const double share : {0.0, 0.03, 0.1}) {
    auto areas = simulated(someBiases(), 0.02, 3);
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> uniform;
    for (AreaObservations& area : areas) {
      for (PairObservation& o : area) {
        float& stretch = o.sources[indexOf(ErrorSource::slope_ranging)];
        stretch = static_cast<float>(0.1 * uniform(random) +
                                     1e-4 * o.row()[indexOf(P::scan_angle_scale)]);
        o.misclosure += share * stretch;
      }
    }
    const DenseSystem with(errors, areas, true), without(errors, areas, false);
    const double absent = 1.0 / (1.0 + std::exp(0.5 * (without.deviance - with.deviance)));
    EXPECT_TRUE(share == 0.0   ? absent > 0.8
                : share == 0.1 ? absent < 1e-6
                               : absent > 0.02 && absent < 0.8)
        << absent;
    const Eigen::VectorXd expected = absent * without.solution + (1.0 - absent) * with.solution;
    const auto weights = unitWeights(areas);
    Adjustment adjustment(errors);
    adjustment.accumulate(areas, weights);
    const AdjustmentSolution solution = adjustment.solve(kSix, SystemVector::Zero());
    for (const P p : kSix) {
      const int i = indexOf(p);
      const double variance =
          absent * without.covariance(i, i) + (1.0 - absent) * with.covariance(i, i) +
          absent * (1.0 - absent) * std::pow(with.solution[i] - without.solution[i], 2);
      EXPECT_NEAR(solution.biases[i], expected[i], 1e-5 * std::sqrt(variance)) << infoOf(p).name;
      EXPECT_GE(solution.covariance(i, i), variance * (1.0 - 1e-5)) << infoOf(p).name;
      EXPECT_LT(solution.covariance(i, i), variance * 2.0) << infoOf(p).name;  // the jackknife's
    }
    const int ranging = errors.sourceUnknown(ErrorSource::slope_ranging);
    EXPECT_NEAR(solution.shared[ranging], expected[8 + ranging], 1e-6);
  }
}

/// Two hundred blocks of white noise: the estimates scatter as the covariance says.
TEST(Adjustment, ScattersAsItsCovarianceSays) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  constexpr int kBlocks = 200;
  SystemVector squares = SystemVector::Zero();
  for (int block = 0; block < kBlocks; ++block) {
    const auto areas = simulated(someBiases(), 0.02, 100 + block);
    const auto weights = unitWeights(areas);
    Adjustment adjustment(errors, 1);
    adjustment.accumulate(areas, weights);
    const AdjustmentSolution solution = adjustment.solve(kSix, SystemVector::Zero());
    for (const P p : kSix) {
      const int i = indexOf(p);
      squares[i] += std::pow(solution.biases[i] - someBiases()[i], 2) / solution.covariance(i, i);
    }
  }
  // Trajectory errors are in the model but not in the data, so the scatter is at most what is said;
  // a chi-square of 200 exceeds 1.25 times its mean in less than one of 100 cases.
  for (const P p : kSix) EXPECT_LT(squares[indexOf(p)] / kBlocks, 1.25) << infoOf(p).name;
}

TEST(Adjustment, SaysWhatEachAreaContributes) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  auto areas = simulated(someBiases(), 0.0, 6);
  for (PairObservation& o : areas.back()) o.row_a = o.row_b = PairRow::Zero();  // tells nothing
  const auto weights = unitWeights(areas);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, weights);
  const std::vector<double> shares = adjustment.informationShares(kSix);
  ASSERT_EQ(shares.size(), areas.size());
  double sum = 0.0;
  for (const double share : shares) sum += share;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  // Not quite nothing: it shows the trajectory's errors to its neighbours.
  EXPECT_LT(shares.back(), 0.1 * shares.front());
}

TEST(Adjustment, ReducedRowsMakeUpTheReducedEquations) {
  // Hardly anything believed of the shared errors: all of N comes from observations.
  SharedErrorModel loose = model();
  loose.position = 100.0;
  loose.roll_pitch = loose.heading = 0.1;
  for (SharedErrorModel::SourcePrior& prior : loose.sources) prior = {1e3, 0.5};
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, loose);
  const auto areas = simulated(someBiases(), 0.02, 7);
  const auto weights = unitWeights(areas);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, weights);
  SystemMatrix sum = SystemMatrix::Zero(), whole = sum;
  for (const AreaObservations& area : areas) {
    for (const PairObservation& o : area) {
      const SystemRow row = adjustment.reducedRow(o);
      sum += row.transpose() * row / o.variance;
      whole += o.row().transpose() * o.row() / o.variance;
    }
  }
  std::vector<P> all;
  for (const SystemParameterInfo& info : systemParameters()) all.push_back(info.parameter);
  const SystemMatrix normal = adjustment.normalOf(all);
  EXPECT_LT((sum - normal).norm(), 1e-5 * normal.norm());
  EXPECT_GT((whole - normal).norm(), 1e-2 * normal.norm());
}

TEST(Adjustment, HoldsWhatIsNotEstimated) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  const auto areas = simulated(someBiases(), 0.0, 3);
  const auto weights = unitWeights(areas);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, weights);
  SystemVector held = SystemVector::Zero();
  held[indexOf(P::lever_arm_x)] = 0.03;
  held[indexOf(P::lever_arm_y)] = -0.05;
  held[indexOf(P::scan_angle_scale)] = 1e-4;
  held[indexOf(P::boresight_heading)] = 2e-5;
  const AdjustmentSolution solution =
      adjustment.solve({P::boresight_pitch, P::boresight_roll}, held);
  EXPECT_DOUBLE_EQ(solution.biases[indexOf(P::lever_arm_x)], 0.03);
  EXPECT_NEAR(solution.biases[indexOf(P::boresight_pitch)], -1.4e-4, 1e-10);
  EXPECT_NEAR(solution.biases[indexOf(P::boresight_roll)], 4.3e-4, 1e-10);
  EXPECT_FALSE(adjustment.solve({}, held).solved);
  EXPECT_EQ(adjustment.solve({}, held).biases, held);
}

TEST(Adjustment, DoesNotDependOnTheNumberOfThreads) {
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  const auto areas = simulated(someBiases(), 0.02, 4);
  const auto weights = unitWeights(areas);
  Adjustment one(errors, 1), eight(errors, 8);
  one.accumulate(areas, weights);
  eight.accumulate(areas, weights);
  EXPECT_EQ(one.solve(kSix, SystemVector::Zero()).biases,
            eight.solve(kSix, SystemVector::Zero()).biases);
}

}  // namespace
}  // namespace pcl_als
