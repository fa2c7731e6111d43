// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include <pcl_als/classification/gaussian_classifier.h>
#include <pcl_als/common/distributions.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als {

void GaussianModel::check() const {
  const auto size = static_cast<Eigen::Index>(bands.size());
  if (bands.empty() || classes.empty())
    throw UsageError("a model of classes needs bands and classes");
  double priors = 0.0;
  std::set<std::string> names;
  for (const GaussianClass& c : classes) {
    if (!names.insert(c.name).second) throw UsageError("class " + c.name + " appears twice");
    const bool fits = c.mean.size() == size && c.covariance.rows() == size &&
                      c.covariance.cols() == size && c.mean.allFinite() && c.covariance.allFinite();
    if (!fits) throw UsageError("class " + c.name + ": mean and covariance must fit the bands");
    if (!c.covariance.isApprox(c.covariance.transpose(), 1e-9) ||
        !CholeskyFactor(c.covariance).succeeded())
      throw UsageError("class " + c.name + ": its covariance is not positive definite");
    if (!(c.prior > 0.0 && c.prior <= 1.0))
      throw UsageError("class " + c.name + ": its prior is no probability");
    priors += c.prior;
  }
  if (std::abs(priors - 1.0) > 1e-6)
    throw UsageError("the priors of all classes together must be 1, not " + std::to_string(priors));
}

MaximumLikelihood::MaximumLikelihood(GaussianModel model, double rejection)
    : model_(std::move(model)) {
  model_.check();
  if (!(rejection >= 0.0 && rejection < 1.0))
    throw UsageError("the probability of rejection must be at least 0 and less than 1");
  const auto bands = static_cast<Eigen::Index>(model_.bands.size());
  largest_distance_sq_ = chiSquaredCritical(rejection, static_cast<double>(bands));
  for (const GaussianClass& c : model_.classes) {
    const CholeskyFactor cholesky(c.covariance);
    whitening_.push_back(
        cholesky.solveLower(Eigen::MatrixXd(Eigen::MatrixXd::Identity(bands, bands))));
    constant_.push_back(std::log(c.prior) - cholesky.lower().diagonal().array().log().sum());
  }
}

MaximumLikelihood::Decision MaximumLikelihood::classify(const double* values) const {
  const auto bands = static_cast<Eigen::Index>(model_.bands.size());
  for (Eigen::Index k = 0; k < bands; ++k)
    if (!std::isfinite(values[k])) return {};
  Decision best;
  double best_score = -std::numeric_limits<double>::infinity();
  // Sum of exp(score - best score): no overflow however unlikely all classes are.
  double sum = 0.0;
  for (std::size_t i = 0; i < model_.classes.size(); ++i) {
    const Eigen::VectorXd& mean = model_.classes[i].mean;
    const Eigen::MatrixXd& whitening = whitening_[i];
    double distance_sq = 0.0;
    for (Eigen::Index row = 0; row < bands; ++row) {
      double along = 0.0;
      for (Eigen::Index k = 0; k <= row; ++k) along += whitening(row, k) * (values[k] - mean[k]);
      distance_sq += along * along;
    }
    const double score = constant_[i] - 0.5 * distance_sq;
    if (score > best_score) {
      sum = sum * std::exp(best_score - score) + 1.0;
      best_score = score;
      best.index = static_cast<int>(i);
      best.distance_sq = distance_sq;
    } else {
      sum += std::exp(score - best_score);
    }
  }
  best.posterior = 1.0 / sum;
  if (best.distance_sq > largest_distance_sq_) best.index = kNoClass;
  return best;
}

std::vector<std::pair<std::string, double>> priorsIn(const std::string& list) {
  std::vector<std::pair<std::string, double>> priors;
  for (const std::string& entry : splitList(list)) {
    const auto prior = assignmentIn(entry);
    if (!prior) throw UsageError("'" + entry + "' is not CLASS=PROBABILITY");
    const auto probability = finiteNumber(prior->second);
    if (!probability || *probability < 0.0 || *probability > 1.0)
      throw UsageError("'" + prior->second + "' is no probability from 0 to 1");
    priors.emplace_back(prior->first, *probability);
  }
  return priors;
}

}  // namespace pcl_als
