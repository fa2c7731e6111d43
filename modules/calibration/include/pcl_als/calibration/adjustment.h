// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Core>

#include <pcl_als/calibration/pair_observation.h>
#include <pcl_als/calibration/trajectory_errors.h>

namespace pcl_als {

/// A solution of the modified least squares adjustment; internal units, all eight parameters.
struct AdjustmentSolution {
  bool solved = false;  ///< false: the normal matrix is singular for the chosen parameters
  SystemVector biases = SystemVector::Zero();
  SystemMatrix formal = SystemMatrix::Zero();  ///< Eq. (26): pairs independent, trajectory exact
  SystemMatrix covariance = SystemMatrix::Zero();  ///< the honest one, see Adjustment
  Eigen::VectorXd trajectory_errors;               ///< by knot: east north up pitch roll heading
};

/** \brief Modified least squares adjustment (Habib et al. 2011, Eqs. (25), (26)) with trajectory
 * errors as nuisance.
 *
 * Every pair is one equation n'(y - A delta) = n'(t_A - t_B) + e of weight w / variance, where t
 * are the errors of the two strips' trajectories. They are eliminated from the normal equations
 * (sparse: overlapping strips, neighbouring knots), which leaves N delta = h for the eight
 * parameters.
 *
 * Covariance: N^-1 where the model's noise explains the scatter. Pairs of one area may share more
 * than that (a surface that changed, vegetation, an effect the model lacks), so the data's part of
 * N is replaced by the scatter of the areas' summed scores (a cluster-robust sandwich) and the
 * larger standard deviation of the two is kept.
 */
class Adjustment {
 public:
  explicit Adjustment(const TrajectoryErrors& errors, int threads = 0);

  /// \param weights one for every observation of every area: robust weight / noise scale^2. Both
  /// must outlive solve().
  void accumulate(const std::vector<AreaObservations>& areas,
                  const std::vector<std::vector<double>>& weights);

  /// Solves for the parameters in \a estimate; the others are held at their value in \a held.
  AdjustmentSolution solve(const std::vector<SystemParameter>& estimate,
                           const SystemVector& held) const;

  /// N of all eight parameters with the trajectory errors eliminated (internal units): what the
  /// data determine.
  const SystemMatrix& reducedNormal() const { return reduced_normal_; }

  /// What a solution leaves of an observation's misclosure, metres.
  double residual(const PairObservation& observation, const AdjustmentSolution& solution) const;

 private:
  using Gradient = Eigen::Matrix<double, Eigen::Dynamic, kSystemParameterCount>;

  Eigen::VectorXd trajectoryErrorsOf(const SystemVector& biases) const;
  SystemMatrix scoreScatter(const AdjustmentSolution& solution) const;

  const TrajectoryErrors& errors_;
  int threads_;
  const std::vector<AreaObservations>* areas_ = nullptr;
  const std::vector<std::vector<double>>* weights_ = nullptr;
  SystemMatrix normal_, reduced_normal_, prior_share_;
  SystemVector right_side_, reduced_right_side_;
  Gradient elimination_;              ///< N_tt^-1 N_tg, unknowns x 8
  Eigen::VectorXd eliminated_right_;  ///< N_tt^-1 h_t
};

}  // namespace pcl_als
