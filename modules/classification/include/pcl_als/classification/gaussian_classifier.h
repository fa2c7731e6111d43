// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// A class as a multivariate normal distribution of the bands.
struct GaussianClass {
  std::string name;
  Eigen::VectorXd mean;        ///< one value per band, in the unit of the band
  Eigen::MatrixXd covariance;  ///< bands x bands; positive definite
  double prior = 0.0;          ///< a priori probability; the sum over the classes is 1
  std::size_t samples = 0;     ///< number of samples from which it was estimated
  double shrinkage = 0.0;      ///< weight of the common variances in the covariance, 0 … 1
};

/// The statistics of all classes, which a classification needs.
struct GaussianModel {
  std::vector<std::string> bands;
  std::vector<GaussianClass> classes;

  /// UsageError for inconsistent statistics or a covariance that is not positive definite.
  void check() const;
};

/// Training samples of one class.
struct TrainingClass {
  std::string name;
  std::vector<Eigen::VectorXd> samples;  ///< one value per band in each
};

struct TrainingResult {
  GaussianModel model;
  std::vector<std::string> remarks;  ///< classes that were excluded or regularised, and why
};

/** \brief Estimates means and covariances (n - 1) of classes; the priors are equal.
 *
 * A covariance from few samples is inaccurate, from one sample it does not exist, and a band
 * without variation within a class makes it singular. The covariance is therefore (1 - w) S + w D,
 * where D has the variances within classes, pooled over all classes, on its diagonal: w = 0 from 10
 * samples per band on, otherwise m / (m + n - 1) with m = bands + 1. In addition w is increased, in
 * powers of ten from 1e-4 on, until no direction has less than 1e-6 of its variance in D. Every w >
 * 0 is reported. Classes without samples and samples that are not finite are excluded.
 *
 * UsageError if fewer than two classes remain, or if samples do not have one value per band.
 * \code
 * const auto trained = pcl_als::trainGaussianModel({"height", "intensity"}, training);
 * const pcl_als::MaximumLikelihood classifier(trained.model);
 * const double values[] = {7.2, 1250.0};  // in the order of the bands
 * const auto decision = classifier.classify(values);
 * if (decision.index != pcl_als::MaximumLikelihood::kNoClass)
 *   std::cout << trained.model.classes[decision.index].name << '\n';
 * \endcode
 */
TrainingResult trainGaussianModel(const std::vector<std::string>& bands,
                                  const std::vector<TrainingClass>& training);

/// Sets the priors of classes by name; the other classes share the remaining probability equally.
/// UsageError for an unknown name, a value that is not a probability, or a sum above 1.
void setPriors(const std::vector<std::pair<std::string, double>>& priors, GaussianModel& model);

/** \brief Gaussian maximum likelihood with priors: the class with the largest
 * ln p - (ln det C + (x - m)' C^-1 (x - m)) / 2.
 *
 * Among classes with equal values the first is chosen. A vector has no class if the probability
 * that a chi-squared variable with as many degrees of freedom as bands exceeds its squared
 * Mahalanobis distance is less than the rejection probability (Richards 1993). Thread-safe.
 */
class MaximumLikelihood {
 public:
  static constexpr int kNoClass = -1;

  struct Decision {
    int index = kNoClass;      ///< index of the class in GaussianModel::classes
    double posterior = 0.0;    ///< posterior probability of the most likely class
    double distance_sq = 0.0;  ///< squared Mahalanobis distance from the most likely class
  };

  /// \param rejection probability in [0, 1); 0: no rejection. UsageError for another value and for
  /// an inconsistent model
  explicit MaximumLikelihood(GaussianModel model, double rejection = 0.0);

  const GaussianModel& model() const { return model_; }
  /// Squared Mahalanobis distance beyond which a vector is rejected.
  double largestDistanceSq() const { return largest_distance_sq_; }
  /// \param values one per band; the result is no class if one is not finite
  Decision classify(const double* values) const;

 private:
  GaussianModel model_;
  double largest_distance_sq_;
  std::vector<Eigen::MatrixXd> whitening_;  ///< inverses of the lower Cholesky factors
  std::vector<double> constant_;            ///< ln p - ln det C / 2
};

/// Parses a list of probabilities "water=0.1,house=0.2". UsageError for another form.
std::vector<std::pair<std::string, double>> priorsIn(const std::string& list);

}  // namespace pcl_als
