// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// A class as a normal distribution over bands.
struct GaussianClass {
  std::string name;
  Eigen::VectorXd mean;        ///< bands, in their units
  Eigen::MatrixXd covariance;  ///< bands x bands; positive definite
  double prior = 0.0;          ///< probability; of all classes together 1
  std::size_t samples = 0;     ///< that it was estimated from
  double shrinkage = 0.0;      ///< weight of the common variances in the covariance, 0 … 1
};

/// The statistics of all classes: what is learnt from training, and all that classifying needs.
struct GaussianModel {
  std::vector<std::string> bands;
  std::vector<GaussianClass> classes;

  /// UsageError for statistics that fit together in no way or a covariance that is not positive
  /// definite.
  void check() const;
};

/// Training: band values of places of one class.
struct TrainingClass {
  std::string name;
  std::vector<Eigen::VectorXd> samples;
};

struct TrainingResult {
  GaussianModel model;
  std::vector<std::string> remarks;  ///< classes left out or regularised, and why
};

/** \brief Means and covariances (n - 1) of classes, with equal priors.
 *
 * Few samples make a poor covariance, one makes none, and a band that does not vary within a class
 * a singular one. So the covariance is (1 - w) S + w D, where D has the variances within classes,
 * pooled over all, on its diagonal: w = 0 from 10 samples per band on, else m / (m + n - 1) with
 * m = bands + 1; and at least so much, in powers of ten from 1e-4 on, that no direction has less
 * than 1e-6 of its variance in D. Every w > 0 is remarked. Classes without samples are left out,
 * and samples that are not finite.
 *
 * UsageError when fewer than two classes remain, or samples do not have one value per band.
 */
TrainingResult trainGaussianModel(const std::vector<std::string>& bands,
                                  const std::vector<TrainingClass>& training);

/// Sets priors by name; the others share what is left equally. UsageError for an unknown name, a
/// value that is no probability, or a sum above 1.
void setPriors(const std::vector<std::pair<std::string, double>>& priors, GaussianModel& model);

/** \brief Gaussian maximum likelihood with priors: the class with the largest
 * ln p - (ln det C + (x - m)' C^-1 (x - m)) / 2.
 *
 * Equal ones: the first. A vector whose squared Mahalanobis distance from its class a chi-squared
 * variable of as many degrees of freedom as bands exceeds with less than the rejection probability
 * is of no class. Thread-safe.
 */
class MaximumLikelihood {
 public:
  static constexpr int kNoClass = -1;

  struct Decision {
    int index = kNoClass;      ///< in the model's classes
    double posterior = 0.0;    ///< of the likeliest class, among the classes of the model
    double distance_sq = 0.0;  ///< squared Mahalanobis distance from it
  };

  /// \param rejection probability in [0, 1); 0: nothing is rejected
  explicit MaximumLikelihood(GaussianModel model, double rejection = 0.0);

  const GaussianModel& model() const { return model_; }
  double largestDistanceSq() const { return largest_distance_sq_; }
  /// \param values one per band; with one that is not finite: no class
  Decision classify(const double* values) const;

 private:
  GaussianModel model_;
  double largest_distance_sq_;
  std::vector<Eigen::MatrixXd> whitening_;  ///< inverses of the lower Cholesky factors
  std::vector<double> constant_;            ///< ln p - ln det C / 2
};

}  // namespace pcl_als
