// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "spike_and_slab.h"

namespace pcl_als {
namespace {

constexpr int kObservations = 40, kUnknowns = 3;

/// Observations y = A x + B z + noise of standard deviation one; z has the prior N(0, 1).
struct Problem {
  Eigen::MatrixXd of_sources = Eigen::MatrixXd::Zero(kObservations, kUnknowns);
  Eigen::MatrixXd of_others = Eigen::MatrixXd::Zero(kObservations, 2);
  Eigen::VectorXd observed = Eigen::VectorXd::Zero(kObservations);

  explicit Problem(const Eigen::Vector3d& values) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    for (int i = 0; i < kObservations; ++i) {
      for (int k = 0; k < kUnknowns; ++k) of_sources(i, k) = normal(random);
      for (int k = 0; k < 2; ++k) of_others(i, k) = normal(random) + 0.7 * of_sources(i, k);
      observed[i] = of_sources.row(i) * values + normal(random);
    }
  }

  /// Posterior of sources and others with these prior variances of the sources.
  void solve(const Eigen::Vector3d& prior, Eigen::VectorXd& mean,
             Eigen::MatrixXd& covariance) const {
    Eigen::MatrixXd all(kObservations, kUnknowns + 2);
    all << of_sources, of_others;
    Eigen::MatrixXd normal = all.transpose() * all;
    normal.diagonal().head<3>() += prior.cwiseInverse();
    normal.diagonal().tail<2>().array() += 1.0;
    covariance = normal.inverse();
    mean = covariance * all.transpose() * observed;
  }

  /// ln of the density of the observations, by their marginal covariance.
  double logEvidence(const Eigen::Vector3d& prior) const {
    const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(kObservations, kObservations) +
                                       of_others * of_others.transpose() +
                                       of_sources * prior.asDiagonal() * of_sources.transpose();
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    return -factor.matrixL().solve(observed).squaredNorm() / 2.0 -
           Eigen::MatrixXd(factor.matrixL()).diagonal().array().log().sum();
  }
};

/// All eight combinations, each solved for on its own and weighted by its evidence.
TEST(SpikeAndSlab, EqualsTheMixtureOfSeparateSolutions) {
  const std::vector<SpikeAndSlab::Prior> priors{{0.9, 0.0, 4.0}, {0.5, 0.0, 1.0}, {0.8, 0.01, 9.0}};
  const Problem problem({0.9, 0.0, 0.3});
  Eigen::VectorXd mean, slab_mean, expected = Eigen::VectorXd::Zero(5);
  Eigen::MatrixXd covariance, slab_covariance, spread = Eigen::MatrixXd::Zero(5, 5);
  problem.solve({4.0, 1.0, 9.0}, slab_mean, slab_covariance);
  const SpikeAndSlab mixture(priors, slab_mean.head<3>(), slab_covariance.topLeftCorner<3, 3>());
  Eigen::Vector3d presence = Eigen::Vector3d::Zero();
  double sum = 0.0;
  for (int pass = 0; pass < 2; ++pass) {
    for (unsigned set = 0; set < 8; ++set) {
      Eigen::Vector3d prior;
      double log_prior = 0.0;
      for (int k = 0; k < 3; ++k) {
        const bool present = ((set >> k) & 1U) != 0;
        prior[k] = present ? priors[k].slab : std::max(priors[k].spike, 1e-12 * priors[k].slab);
        log_prior += std::log(present ? 1.0 - priors[k].absent : priors[k].absent);
      }
      const double weight = std::exp(log_prior + problem.logEvidence(prior) + 60.0);
      if (pass == 0) {
        sum += weight;
        continue;
      }
      problem.solve(prior, mean, covariance);
      expected += weight / sum * mean;
      spread += weight / sum * (covariance + mean * mean.transpose());
      for (int k = 0; k < 3; ++k) presence[k] += ((set >> k) & 1U) != 0 ? weight / sum : 0.0;
    }
  }
  spread -= expected * expected.transpose();
  EXPECT_GT(presence[0], 0.9);
  EXPECT_LT(presence[1], 0.4);
  EXPECT_LT((mixture.presence() - presence).cwiseAbs().maxCoeff(), 1e-8);  // rounding
  const Eigen::MatrixXd others = slab_covariance.bottomLeftCorner<2, 3>();
  EXPECT_LT((slab_mean.tail<2>() + mixture.move(others) - expected.tail<2>()).norm(), 1e-8);
  EXPECT_LT((slab_covariance.bottomRightCorner<2, 2>() + mixture.change(others) -
             spread.bottomRightCorner<2, 2>())
                .norm(),
            1e-8);
}

/// Observations whose variance is four times the stated one: less is known of the same values.
TEST(SpikeAndSlab, OverdispersionMakesPresenceLessCertain) {
  const Problem problem({0.6, 0.0, 0.0});
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  problem.solve({4.0, 4.0, 4.0}, mean, covariance);
  const std::vector<SpikeAndSlab::Prior> priors(3, {0.9, 0.0, 4.0});
  const SpikeAndSlab stated(priors, mean.head<3>(), covariance.topLeftCorner<3, 3>());
  const SpikeAndSlab larger(priors, mean.head<3>(), covariance.topLeftCorner<3, 3>(),
                            SpikeAndSlab::Certainty{4.0});
  EXPECT_GT(stated.presence()[0], larger.presence()[0]);
  EXPECT_NEAR(larger.stdIfPresent()[0] / stated.stdIfPresent()[0], 2.0, 0.2);
}

/// One value observed with the variance v, slab s: the odds of presence by hand.
TEST(SpikeAndSlab, FewDegreesOfFreedomMakePresenceLessCertain) {
  constexpr double kValue = 3.6, kVariance = 1.0, kSlab = 64.0, kFreedom = 10.0;
  const double posterior = 1.0 / (1.0 / kVariance + 1.0 / kSlab);
  const Eigen::VectorXd mean = Eigen::VectorXd::Constant(1, posterior * kValue / kVariance);
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(1, 1, posterior);
  const double explained = kValue * kValue / kVariance * kSlab / (kSlab + kVariance);
  const double prior_odds = 0.1 / 0.9 * std::sqrt(kVariance / (kVariance + kSlab));
  const double normal = prior_odds * std::exp(0.5 * explained);
  const double student = prior_odds * std::pow(1.0 + explained / kFreedom, 0.5 * (kFreedom + 1.0));
  const std::vector<SpikeAndSlab::Prior> prior{{0.9, 0.0, kSlab}};
  EXPECT_NEAR(SpikeAndSlab(prior, mean, covariance).presence()[0], normal / (1.0 + normal), 1e-6);
  EXPECT_NEAR(
      SpikeAndSlab(prior, mean, covariance, SpikeAndSlab::Certainty{1.0, kFreedom}).presence()[0],
      student / (1.0 + student), 1e-6);
  EXPECT_LT(student, 0.2 * normal);
}

/// A prior that the observations do not change leaves the probability as it was.
TEST(SpikeAndSlab, WithoutObservationsThePriorRemains) {
  const SpikeAndSlab mixture({{0.9, 0.0, 4.0}}, Eigen::VectorXd::Zero(1),
                             Eigen::MatrixXd::Constant(1, 1, 4.0));
  EXPECT_NEAR(mixture.presence()[0], 0.1, 1e-9);
  EXPECT_NEAR(mixture.stdIfPresent()[0], 2.0, 1e-9);
}

}  // namespace
}  // namespace pcl_als
