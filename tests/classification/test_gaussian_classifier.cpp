// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <pcl_als/classification/gaussian_classifier.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

using Samples = std::vector<Eigen::VectorXd>;

/// Correlated samples about a centre, drawn with a fixed seed.
Samples draw(const Eigen::Vector3d& centre, const Eigen::Matrix3d& root, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Samples samples;
  for (int i = 0; i < count; ++i) {
    const double u = normal(random), v = normal(random), w = normal(random);
    samples.push_back(centre + root * Eigen::Vector3d(u, v, w));
  }
  return samples;
}

std::vector<TrainingClass> fourClasses() {
  Eigen::Matrix3d a, b;
  a << 2.0, 0, 0, 0.6, 1.0, 0, -0.3, 0.2, 0.5;
  b << 0.3, 0, 0, 4.0, 6.0, 0, 0.1, 0.0, 0.2;
  return {{"tree", draw({8, 60, 1.0}, a, 80, 1)},
          {"grass", draw({0, 58, 0.1}, b, 70, 2)},
          {"soil", draw({0.1, 30, 0.1}, b, 75, 3)},
          {"built-up", draw({5, 25, 0.3}, 1.5 * a, 90, 4)}};
}

const std::vector<std::string> kBands{"height", "intensity", "roughness"};

/// The decision straight from the formula: sums in long double, determinant and inverse by minors.
int directClass(const std::vector<TrainingClass>& training, const double* x) {
  int best = -1;
  long double best_score = 0;
  for (std::size_t c = 0; c < training.size(); ++c) {
    const auto n = static_cast<long double>(training[c].samples.size());
    long double m[3] = {0, 0, 0}, s[3][3] = {};
    for (const auto& sample : training[c].samples)
      for (int i = 0; i < 3; ++i) m[i] += sample[i] / n;
    for (const auto& sample : training[c].samples)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) s[i][j] += (sample[i] - m[i]) * (sample[j] - m[j]) / (n - 1);
    long double adjugate[3][3], determinant = 0, distance = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int a = (j + 1) % 3, b = (j + 2) % 3, d = (i + 1) % 3, e = (i + 2) % 3;
        adjugate[i][j] = s[a][d] * s[b][e] - s[a][e] * s[b][d];
      }
    for (int j = 0; j < 3; ++j) determinant += s[0][j] * adjugate[j][0];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        distance += (x[i] - m[i]) * adjugate[i][j] / determinant * (x[j] - m[j]);
    const long double score = -std::log(determinant) - distance;
    if (best < 0 || score > best_score) best = static_cast<int>(c), best_score = score;
  }
  return best;
}

// A decision can differ only where two scores agree to rounding; none of 200,000 cells does.
TEST(MaximumLikelihood, EqualsTheFormulaCellForCell) {
  const std::vector<TrainingClass> training = fourClasses();
  const TrainingResult trained = trainGaussianModel(kBands, training);
  EXPECT_TRUE(trained.remarks.empty());
  const MaximumLikelihood classifier(trained.model);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t different = 0, seen[4] = {0, 0, 0, 0};
  for (int i = 0; i < 200000; ++i) {
    const double x[] = {-2.0 + 14.0 * unit(random), 90.0 * unit(random), 2.0 * unit(random)};
    const int index = classifier.classify(x).index;
    different += index != directClass(training, x);
    ++seen[index];
  }
  EXPECT_EQ(different, 0U);
  for (const std::size_t count : seen) EXPECT_GT(count, 1000U);
}

// One band, variances 1 and 4, means 0 and 4, by hand at x = 1: densities exp(-1/2) / 1 and
// exp(-9/8) / 2.
TEST(MaximumLikelihood, PosteriorByHand) {
  GaussianModel model{{"a"}, {}};
  for (const auto& [name, mean, variance] : {std::tuple("x", 0.0, 1.0), std::tuple("y", 4.0, 4.0)})
    model.classes.push_back({name, Eigen::VectorXd::Constant(1, mean),
                             Eigen::MatrixXd::Constant(1, 1, variance), 0.5, 50, 0.0});
  const double at = 1.0, p = std::exp(-0.5), q = std::exp(-9.0 / 8.0) / 2.0;
  EXPECT_NEAR(MaximumLikelihood(model).classify(&at).posterior, p / (p + q), 1e-12);
  EXPECT_NEAR(MaximumLikelihood(model).classify(&at).distance_sq, 1.0, 1e-12);
  setPriors({{"y", 0.9}}, model);
  EXPECT_NEAR(model.classes[0].prior, 0.1, 1e-12);
  const MaximumLikelihood::Decision decision = MaximumLikelihood(model).classify(&at);
  EXPECT_EQ(decision.index, 1);
  EXPECT_NEAR(decision.posterior, 0.9 * q / (0.1 * p + 0.9 * q), 1e-12);
  const double far = 1e6;  // densities underflow, the decision does not
  EXPECT_EQ(MaximumLikelihood(model).classify(&far).index, 1);
  EXPECT_EQ(MaximumLikelihood(model).classify(&far).posterior, 1.0);
}

// The 5 % point of chi-squared with one degree of freedom is 3.8415: 1.96 deviations.
TEST(MaximumLikelihood, RejectsWhatIsFarFromEveryClass) {
  GaussianModel model{{"a"}, {}};
  for (const double mean : {0.0, 10.0})
    model.classes.push_back({std::to_string(mean), Eigen::VectorXd::Constant(1, mean),
                             Eigen::MatrixXd::Identity(1, 1), 0.5, 50, 0.0});
  const MaximumLikelihood classifier(model, 0.05);
  EXPECT_NEAR(classifier.largestDistanceSq(), 3.8415, 5e-5);
  const double near = 1.95, far = 1.97, none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(classifier.classify(&near).index, 0);
  EXPECT_EQ(classifier.classify(&far).index, MaximumLikelihood::kNoClass);
  EXPECT_GT(classifier.classify(&far).posterior, 0.99);
  EXPECT_EQ(classifier.classify(&none).index, MaximumLikelihood::kNoClass);
  EXPECT_THROW(MaximumLikelihood(model, 1.0), UsageError);
}

TEST(GaussianTraining, OneSampleTakesTheCommonVariances) {
  std::vector<TrainingClass> training = fourClasses();
  training.push_back({"water", {Eigen::Vector3d(-1, 5, 0)}});
  const TrainingResult trained = trainGaussianModel(kBands, training);
  const GaussianClass& water = trained.model.classes.back();
  EXPECT_EQ(water.shrinkage, 1.0);
  EXPECT_TRUE(water.covariance.isDiagonal());
  ASSERT_EQ(trained.remarks.size(), 1U);
  EXPECT_NE(trained.remarks[0].find("class water: covariance from 1 sample regularised with 100 %"),
            std::string::npos)
      << trained.remarks[0];
  const double x[] = {-1.0, 5.0, 0.0};
  EXPECT_EQ(MaximumLikelihood(trained.model).classify(x).index, 4);
}

// m = bands + 1 = 4 and n = 10: the weight is 4 / 13.
TEST(GaussianTraining, ThinClassesAreRegularisedAndSaid) {
  std::vector<TrainingClass> training = fourClasses();
  training[0].samples.resize(10);
  const TrainingResult trained = trainGaussianModel(kBands, training);
  EXPECT_NEAR(trained.model.classes[0].shrinkage, 4.0 / 13.0, 1e-12);
  EXPECT_EQ(trained.model.classes[1].shrinkage, 0.0);
  EXPECT_EQ(trained.remarks.size(), 1U);
}

TEST(GaussianTraining, ABandThatDoesNotVaryIsNoObstacle) {
  std::vector<TrainingClass> training = fourClasses();
  for (Eigen::VectorXd& sample : training[2].samples) sample[2] = 0.0;
  TrainingResult trained = trainGaussianModel(kBands, training);
  EXPECT_EQ(trained.remarks.size(), 1U);
  EXPECT_GT(trained.model.classes[2].shrinkage, 0.0);
  EXPECT_LE(trained.model.classes[2].shrinkage, 1e-3);
  EXPECT_NO_THROW(trained.model.check());
  // Nor is one that varies in no class at all, or one that is a multiple of another.
  for (TrainingClass& c : training)
    for (Eigen::VectorXd& sample : c.samples) sample[2] = 5.0, sample[1] = 3.0 * sample[0];
  trained = trainGaussianModel(kBands, training);
  EXPECT_EQ(trained.remarks.size(), 4U);
  EXPECT_NO_THROW(trained.model.check());
}

TEST(GaussianTraining, LeavesOutClassesWithoutSamples) {
  std::vector<TrainingClass> training = fourClasses();
  training[1].samples.clear();
  training[2].samples = {Eigen::Vector3d(0, std::nan(""), 0)};
  const TrainingResult trained = trainGaussianModel(kBands, training);
  EXPECT_EQ(trained.model.classes.size(), 2U);
  EXPECT_EQ(trained.remarks.size(), 2U);
  EXPECT_EQ(trained.model.classes[0].prior, 0.5);
  training[0].samples.clear();
  EXPECT_THROW(trainGaussianModel(kBands, training), UsageError);
  training[3].samples[0] = Eigen::Vector2d(1, 2);
  EXPECT_THROW(trainGaussianModel(kBands, training), UsageError);
}

TEST(GaussianModel, StatisticsThatContradictEachOtherAreRefused) {
  const GaussianModel good = trainGaussianModel(kBands, fourClasses()).model;
  EXPECT_NO_THROW(good.check());
  GaussianModel twice = good;
  twice.classes[1].name = twice.classes[0].name;
  EXPECT_THROW(twice.check(), UsageError);
  GaussianModel priors = good;
  priors.classes[0].prior = 0.9;
  EXPECT_THROW(priors.check(), UsageError);
  GaussianModel singular = good;
  singular.classes[2].covariance.setOnes();
  EXPECT_THROW(singular.check(), UsageError);
}

TEST(GaussianTraining, PriorsAreProbabilities) {
  GaussianModel model = trainGaussianModel(kBands, fourClasses()).model;
  setPriors({{"tree", 0.4}, {"soil", 0.3}}, model);
  EXPECT_NEAR(model.classes[1].prior, 0.15, 1e-12);
  using Priors = std::vector<std::pair<std::string, double>>;
  for (const Priors& bad : {Priors{{"water", 0.1}}, Priors{{"tree", 0.0}}, Priors{{"tree", 1.5}},
                            Priors{{"tree", 0.7}, {"soil", 0.7}}})
    EXPECT_THROW(setPriors(bad, model), UsageError);
}

}  // namespace
}  // namespace pcl_als
