// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "pair_observation.h"
#include "shared_errors.h"

namespace pcl_als {

/// A solution of the modified least squares adjustment; internal units, all eight parameters.
struct AdjustmentSolution {
  bool solved = false;  ///< false: the normal matrix is singular for the chosen parameters
  SystemVector biases = SystemVector::Zero();
  SystemMatrix formal = SystemMatrix::Zero();      ///< Eq. (26): noise of points only
  SystemMatrix covariance = SystemMatrix::Zero();  ///< includes shared errors, see Adjustment
  /// C, the inverse of the normal matrix with the prior: the part of covariance that the noise of
  /// points and the shared errors explain.
  SystemMatrix model = SystemMatrix::Zero();
  /// The part of covariance that stems from the observations, not from the prior L of the
  /// parameters: C (N - L) C, enlarged as covariance is.
  SystemMatrix of_flight = SystemMatrix::Zero();
  Eigen::VectorXd shared;  ///< shared errors, in the order of SharedErrors
  /// By error source: probability that it is present; value and standard deviation where it is.
  ErrorSourceVector source_probability = ErrorSourceVector::Zero();
  ErrorSourceVector source_value = ErrorSourceVector::Zero();
  ErrorSourceVector source_std = ErrorSourceVector::Zero();
};

class AreaNormal;    // normal equations of one area
struct ErrorNormal;  // their sum
class StripCovariance;

/// Restricted likelihood of variance components, with its derivatives with respect to their
/// logarithms, in the order of VarianceFactors::values().
struct RestrictedLikelihood {
  static constexpr int kCount = VarianceFactors::kCount;
  /// -2 ln of the likelihood, without a constant; infinite where the parameters cannot be solved
  /// for, and then there are no derivatives.
  double deviance = std::numeric_limits<double>::infinity();
  Eigen::Matrix<double, kCount, 1> gradient = Eigen::Matrix<double, kCount, 1>::Zero();
  /// Average information: the mean of the observed and the expected second derivatives of the
  /// deviance with respect to the components, times the components (Gilmour, Thompson and Cullis
  /// 1995, Biometrics 51).
  Eigen::Matrix<double, kCount, kCount> information = Eigen::Matrix<double, kCount, kCount>::Zero();
};

/** \brief Modified least squares adjustment (Habib et al. 2011, Eqs. (25), (26)) with shared errors
 * as nuisance parameters.
 *
 * Every pair gives one equation n'(y - A delta) = n'(t_A - t_B) + e of weight w / variance, where t
 * are the errors that the points of a strip share. They are eliminated from the sparse normal
 * equations (couplings exist between neighbouring knots and between overlapping strips only), which
 * leaves N delta = h for the eight parameters.
 *
 * Covariance: N^-1 where the model's noise explains the scatter. Pairs of one area may share
 * further errors (a surface that changed, vegetation, effects that the model lacks). The
 * contribution of the data to N is therefore also replaced by the jackknife over areas (the change
 * of the solution when one area is excluded, from the normal equations of each area), and the
 * larger of the two standard deviations is used.
 *
 * Noise of the measured slopes acts like information, sum w t't (t: PairObservation::tilt) over
 * pairs. Where half of the information in a direction may stem from this noise, the direction
 * counts as not determined: its standard deviation becomes so large that the parameter is not
 * estimated.
 */
class Adjustment {
 public:
  explicit Adjustment(const SharedErrors& errors, int threads = 0);
  /// The adjustment of some areas of another one that has accumulated them, with its variance
  /// components. Its normal equations are not computed again.
  Adjustment(const Adjustment& whole, const std::vector<bool>& areas);
  ~Adjustment();
  /// A copy has the same normal equations, which are not computed again.
  Adjustment(const Adjustment&);
  Adjustment& operator=(const Adjustment&);

  /// \param weights one for every observation of every area: robust weight / noise scale^2
  void accumulate(const std::vector<AreaObservations>& areas,
                  const std::vector<std::vector<double>>& weights);
  void setVarianceFactors(const VarianceFactors& levels);
  const VarianceFactors& levels() const { return levels_; }
  /// The same unknowns with other priors, or other error sources considered. Solutions are those of
  /// the new ones after the next setVarianceFactors() or accumulate(), restrictedLikelihood() at
  /// once.
  void setErrors(const SharedErrors& errors) { errors_ = errors; }
  const SharedErrors& errors() const { return errors_; }

  /// Likelihood of variance components after accumulate(); the parameters in \a estimate are
  /// integrated out. Computes a factor of the normal matrix and the entries of its inverse where
  /// the prior or an area couple unknowns: the cost of about three solutions.
  /// \param differentiated_below derivatives are computed of a smaller deviance only
  RestrictedLikelihood restrictedLikelihood(
      const VarianceFactors& levels, const std::vector<SystemParameter>& estimate,
      double differentiated_below = std::numeric_limits<double>::infinity()) const;

  /// Solves for the parameters in \a estimate; the others are held at their values in \a held.
  /// \a prior_information: inverse variances of priors of mean zero, zero for none.
  AdjustmentSolution solve(const std::vector<SystemParameter>& estimate, const SystemVector& held,
                           const SystemVector& prior_information = SystemVector::Zero()) const;

  /// Solves for all of \a estimate with a prior of mean zero and standard deviations \a prior, so
  /// that parameters that are not determined stay near zero. Used during the iteration; its
  /// covariances are those of the model.
  AdjustmentSolution solveNearZero(const std::vector<SystemParameter>& estimate,
                                   const SystemVector& prior) const;

  /// The unknowns of a system after the first; system > 0.
  struct SystemSolution {
    SystemUnknowns difference, difference_std;  ///< to those of the first system
    SystemUnknowns std;                         ///< of the system's own values
  };
  SystemSolution systemSolution(int system, const std::vector<SystemParameter>& estimate,
                                const AdjustmentSolution& solution) const;

  /// The differences of systems after the first to the first one, with their covariances, and their
  /// variances by the scatter of the areas (scatterVariance()).
  struct SystemPosterior {
    SystemUnknowns mean, scatter;
    Eigen::Matrix<double, kSystemUnknownCount, kSystemUnknownCount> covariance;
  };
  std::vector<SystemPosterior> systemPosteriors(const std::vector<int>& systems,
                                                const std::vector<SystemParameter>& estimate,
                                                const AdjustmentSolution& solution) const;

  /// Derivative of the estimated parameters with respect to the value at which an error source is
  /// held that is not considered; internal units.
  SystemVector derivativeBySource(ErrorSource source,
                                  const std::vector<SystemParameter>& estimate) const;

  /// A solution without estimates: all parameters are held, and there are no shared errors.
  AdjustmentSolution unsolved(const SystemVector& held) const;

  /// Normal matrix N of all eight parameters with the shared errors eliminated (internal units),
  /// and its right side. The prior in it is what SharedErrorModel::biases says of \a estimate
  /// alone.
  SystemMatrix normalOf(const std::vector<SystemParameter>& estimate) const;
  SystemVector rightOf(const std::vector<SystemParameter>& estimate) const;

  /// Row of an observation in the reduced equations: its sensitivity to the parameters after
  /// elimination of the shared errors (shifts of areas excepted).
  SystemRow reducedRow(const PairObservation& observation) const;

  /// Contribution of each area to the determination of these parameters: its part of the trace of
  /// N^-1 N, in [0, 1].
  std::vector<double> informationShares(const std::vector<SystemParameter>& estimate) const;

  /// A posteriori covariances of the trajectory errors of a solution, for the covariance of its
  /// parameters; about the cost of restrictedLikelihood(). Null before accumulate().
  std::unique_ptr<const StripCovariance> stripCovariance(const AdjustmentSolution& solution) const;

  /// Residual of an observation after a solution, shifts of areas included, metres.
  double residual(const PairObservation& observation, const AdjustmentSolution& solution) const;

 private:
  struct Reduced;  // normal equations with the shared errors eliminated
  struct Areas;    // normal equations of the areas

  std::unique_ptr<const ErrorNormal> assemble(double shift_variance) const;
  Reduced reduce(const ErrorNormal& normal, const VarianceFactors& levels) const;
  /// Contribution of one area to the reduced equations at a solution.
  struct Share {
    SystemVector score;
    SystemMatrix normal;
  };
  Share shareOf(std::size_t area, const AdjustmentSolution& solution) const;
  /// Factors by which noise of the slopes may have made standard deviations too small.
  Eigen::VectorXd slopeNoise(const Eigen::MatrixXd& independent,
                             const std::vector<SystemParameter>& estimate) const;
  /// Averages over the models with and without each of the error sources: changes the solution,
  /// returns the change of its covariance.
  SystemMatrix averageSources(const SystemMatrix& model, AdjustmentSolution& solution) const;
  /// Covariances of all unknowns to some values: the influence of the equations on these.
  struct Influence {
    Eigen::MatrixXd biases, shared;  ///< a column for each value
  };
  Influence sourceInfluence(const SystemMatrix& model,
                            const std::vector<ErrorSource>& sources) const;
  /// On the differences of a system to the first one. \a model: covariance of the parameters.
  Influence differenceInfluence(int system, const SystemMatrix& model) const;
  /// Covariance of the parameters in \a estimate by the model; zero where they are singular.
  SystemMatrix modelCovariance(const std::vector<SystemParameter>& estimate) const;
  /// Right sides of the normal equations of each area that remain at a solution.
  using AreaResiduals = std::vector<Eigen::VectorXd>;
  AreaResiduals areaResiduals(const AdjustmentSolution& solution) const;
  /// The contributions of each area to the values.
  std::vector<Eigen::VectorXd> areaScores(const Influence& influence,
                                          const AreaResiduals& residuals) const;
  /// Variances of the values, of which the observations' contribution is the scatter of the areas.
  Eigen::VectorXd scatterVariance(const Influence& influence,
                                  const std::vector<SystemParameter>& estimate,
                                  const AreaResiduals& residuals) const;
  /// Factor by which the scatter between areas makes the variances of the error sources larger than
  /// those of the model, with the degrees of freedom of this scatter.
  struct SourceCertainty {
    double overdispersion = 1.0, freedom = 1.0;
  };
  SourceCertainty sourceCertainty(const Influence& influence,
                                  const AdjustmentSolution& solution) const;
  /// \param all the reduced normal matrix, with priors
  SystemMatrix jackknife(const AdjustmentSolution& solution,
                         const std::vector<SystemParameter>& estimate,
                         const SystemMatrix& all) const;

  SharedErrors errors_;
  int threads_;
  VarianceFactors levels_;
  std::shared_ptr<const Areas> areas_;
  std::shared_ptr<const ErrorNormal> normal_;
  std::shared_ptr<const Reduced> reduced_;
};

/// Variance components estimated from the observations.
struct EstimatedLevels {
  VarianceFactors most_likely;  ///< where a further estimation begins
  /// The expectation of each variance for a normal distribution of its logarithm about the most
  /// likely one. Those of the adjustment.
  VarianceFactors expected;
};

/** \brief Estimates the variance components of the shared errors by restricted maximum likelihood
 * (REML), and sets the adjustment to their expectations.
 *
 * Each is the variance of the model times a factor between 1/4096 and 16 (attitude: 1024), with a
 * Cauchy prior on the logarithm of the factor (scale: a factor of e): a component that the
 * observations do not determine keeps the model's variance, and one that they do determine is
 * hardly affected by the prior. The prior of a heading component is about that of roll and pitch
 * where this is larger than the model's. The minimum is found by Newton's method within a trust
 * region, with the average information as the curvature, in the logarithms of the factors.
 *
 * \param start the most likely components of similar observations, if there are any
 * \param tolerance the search ends where a further step would change -2 ln of the likelihood by
 * less (a standard deviation changes it by one)
 */
EstimatedLevels estimateLevels(Adjustment& adjustment, const std::vector<SystemParameter>& estimate,
                               const VarianceFactors& start = {}, double tolerance = 0.01);

}  // namespace pcl_als
