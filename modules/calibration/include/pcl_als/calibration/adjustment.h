// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/calibration/pair_observation.h>
#include <pcl_als/calibration/shared_errors.h>

namespace pcl_als {

/// A solution of the modified least squares adjustment; internal units, all eight parameters.
struct AdjustmentSolution {
  bool solved = false;  ///< false: the normal matrix is singular for the chosen parameters
  SystemVector biases = SystemVector::Zero();
  SystemMatrix formal = SystemMatrix::Zero();      ///< Eq. (26): only the noise of points
  SystemMatrix covariance = SystemMatrix::Zero();  ///< includes shared errors, see Adjustment
  Eigen::VectorXd shared;                          ///< shared errors, in the order of SharedErrors
};

class AreaNormal;  // normal equations of one area

/** \brief Modified least squares adjustment (Habib et al. 2011, Eqs. (25), (26)) with shared errors
 * as nuisance.
 *
 * Every pair is one equation n'(y - A delta) = n'(t_A - t_B) + e of weight w / variance, where t
 * are the errors that the points of a strip share. They are eliminated from the normal equations
 * (sparse: overlapping strips, neighbouring knots), which leaves N delta = h for the eight
 * parameters.
 *
 * Covariance: N^-1 where the model's noise explains the scatter. Pairs of one area may share more
 * than that (a surface that changed, vegetation, an effect the model lacks), so the data's part of
 * N is replaced by how far the solution moves when areas are left out, one after the other (the
 * jackknife, from each area's own normal equations), and the larger standard deviation of the two
 * is kept.
 *
 * Noise of the measured slopes acts like information, sum w tilt_variance (A'A - r'r) of pairs
 * with rows r = n'A. Where half of what a direction seems to be determined by may be that, nothing
 * is: standard deviations grow accordingly, without limit in effect.
 */
class Adjustment {
 public:
  explicit Adjustment(const SharedErrors& errors, int threads = 0);
  ~Adjustment();

  /// \param weights one for every observation of every area: robust weight / noise scale^2. Both
  /// must outlive solve().
  void accumulate(const std::vector<AreaObservations>& areas,
                  const std::vector<std::vector<double>>& weights);
  void setLevels(const SharedErrorLevels& levels);
  const SharedErrorLevels& levels() const { return levels_; }

  /// -2 ln of the likelihood that the observations have these levels of shared errors (restricted:
  /// whatever the values of the parameters in \a estimate); a constant is left out. Infinite where
  /// the parameters cannot be solved for.
  double deviance(const SharedErrorLevels& levels,
                  const std::vector<SystemParameter>& estimate) const;

  /// Solves for the parameters in \a estimate; the others are held at their value in \a held.
  AdjustmentSolution solve(const std::vector<SystemParameter>& estimate,
                           const SystemVector& held) const;

  /// Solves for all of \a estimate with a prior of zero and the standard deviations \a prior
  /// (standard deviations): undetermined parameters stay near zero. For the way to a
  /// solution; its covariances are the model's.
  AdjustmentSolution solveNearZero(const std::vector<SystemParameter>& estimate,
                                   const SystemVector& prior) const;

  /// A solution that estimates nothing: all parameters held, no shared errors.
  AdjustmentSolution unsolved(const SystemVector& held) const;

  /// N of all eight parameters with the shared errors eliminated (internal units): what the data
  /// determine.
  const SystemMatrix& reducedNormal() const;

  /// An observation's row of the reduced equations: what it shows of the parameters where the
  /// shared errors take over what they can (local shifts excepted).
  SystemRow reducedRow(const PairObservation& observation) const;

  /// What each area contributes to the determination of these parameters: its part of the trace of
  /// N^-1 N, in [0, 1].
  std::vector<double> informationShares(const std::vector<SystemParameter>& estimate) const;

  /// What a solution leaves of an observation's misclosure, local shifts included, metres.
  double residual(const PairObservation& observation, const AdjustmentSolution& solution) const;

 private:
  struct Normal;   // the whole system
  struct Reduced;  // the shared errors eliminated

  std::unique_ptr<const Normal> assemble(double shift_variance) const;
  Reduced reduce(const Normal& normal, const SharedErrorLevels& levels) const;
  /// What one area contributes to the reduced equations at a solution.
  struct Share {
    SystemVector score;
    SystemMatrix normal;
  };
  Share shareOf(std::size_t area, const AdjustmentSolution& solution) const;
  /// By how much the noise of the slopes may have made standard deviations too small.
  Eigen::VectorXd slopeNoise(const Eigen::MatrixXd& independent,
                             const std::vector<SystemParameter>& estimate) const;
  /// Counts with an instrument that ranges without error on slopes: moves the solution, returns the
  /// change of its covariance.
  SystemMatrix doubtRanging(const SystemMatrix& model, AdjustmentSolution& solution) const;
  SystemMatrix jackknife(const AdjustmentSolution& solution,
                         const std::vector<SystemParameter>& estimate) const;

  const SharedErrors& errors_;
  int threads_;
  SharedErrorLevels levels_;
  const std::vector<AreaObservations>* areas_ = nullptr;
  const std::vector<std::vector<double>>* weights_ = nullptr;
  std::vector<AreaNormal> area_normals_;
  SystemMatrix slope_noise_ = SystemMatrix::Zero();  ///< information that may stem from noise
  std::unique_ptr<const Normal> normal_;
  std::unique_ptr<Reduced> reduced_;
};

/** \brief Estimates the variance components of the shared errors by restricted maximum likelihood
 * (REML), sets the adjustment to them, and returns them.
 *
 * Each is the variance of the model times a factor between 1/4096 and 16, with a Cauchy prior on
 * the logarithm of the factor (scale: a factor of e): a component that the observations do not
 * determine keeps the model's variance, and one that they do determine is hardly affected by the
 * prior. The minimum is found by coordinate descent, with factors of 16, of two, then of 2^(1/4).
 */
SharedErrorLevels mostLikelyLevels(Adjustment& adjustment,
                                   const std::vector<SystemParameter>& estimate);

}  // namespace pcl_als
