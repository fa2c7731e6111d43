// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// A class as a normal distribution over bands.
struct GaussianClass {
  std::string name;
  Eigen::VectorXd mean;        ///< bands, in their units
  Eigen::MatrixXd covariance;  ///< bands x bands; positive definite
  double prior = 0.0;          ///< probability; of all classes together 1
  std::size_t samples = 0;     ///< number of samples from which it was estimated
  double shrinkage = 0.0;      ///< weight of the common variances in the covariance, 0 … 1
};

/// The statistics of all classes, from training; all that a classification needs.
struct GaussianModel {
  std::vector<std::string> bands;
  std::vector<GaussianClass> classes;

  /// UsageError for inconsistent statistics or a covariance that is not positive definite.
  void check() const;
};

/// Training: band values of places of one class.
struct TrainingClass {
  std::string name;
  std::vector<Eigen::VectorXd> samples;
};

struct TrainingResult {
  GaussianModel model;
  std::vector<std::string> remarks;  ///< classes excluded or regularised, and why
};

/** \brief Means and covariances (n - 1) of classes, with equal priors.
 *
 * A covariance from few samples is inaccurate, from one sample it does not exist, and a band
 * without variation within a class makes it singular. The covariance is therefore (1 - w) S + w D,
 * where D has the variances within classes, pooled over all classes, on its diagonal: w = 0 from 10
 * samples per band on, otherwise m / (m + n - 1) with m = bands + 1. In addition w is increased, in
 * powers of ten from 1e-4 on, until no direction has less than 1e-6 of its variance in D. Every w >
 * 0 is reported. Classes without samples and samples that are not finite are excluded.
 *
 * UsageError when fewer than two classes remain, or samples do not have one value per band.
 */
TrainingResult trainGaussianModel(const std::vector<std::string>& bands,
                                  const std::vector<TrainingClass>& training);

/// Sets priors by name; the others share the remaining probability equally. UsageError for an
/// unknown name, a value that is not a probability, or a sum above 1.
void setPriors(const std::vector<std::pair<std::string, double>>& priors, GaussianModel& model);

/** \brief Gaussian maximum likelihood with priors: the class with the largest
 * ln p - (ln det C + (x - m)' C^-1 (x - m)) / 2.
 *
 * Of classes with equal values the first is chosen. A vector has no class if the probability that a
 * chi-squared variable with as many degrees of freedom as bands exceeds its squared Mahalanobis
 * distance is less than the rejection probability. Thread-safe.
 */
class MaximumLikelihood {
 public:
  static constexpr int kNoClass = -1;

  struct Decision {
    int index = kNoClass;      ///< in the model's classes
    double posterior = 0.0;    ///< of the likeliest class, among the classes of the model
    double distance_sq = 0.0;  ///< squared Mahalanobis distance from it
  };

  /// \param rejection probability in [0, 1); 0: no rejection
  explicit MaximumLikelihood(GaussianModel model, double rejection = 0.0);

  const GaussianModel& model() const { return model_; }
  double largestDistanceSq() const { return largest_distance_sq_; }
  /// \param values one per band; no class if one is not finite
  Decision classify(const double* values) const;

 private:
  GaussianModel model_;
  double largest_distance_sq_;
  std::vector<Eigen::MatrixXd> whitening_;  ///< inverses of the lower Cholesky factors
  std::vector<double> constant_;            ///< ln p - ln det C / 2
};

/// The probabilities of a list "water=0.1,house=0.2". UsageError for another form.
std::vector<std::pair<std::string, double>> priorsIn(const std::string& list);

}  // namespace pcl_als
