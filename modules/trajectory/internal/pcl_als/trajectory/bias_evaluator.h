// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <memory>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/coverage_count.h>
#include <pcl_als/trajectory/point_columns.h>
#include <pcl_als/trajectory/trajectory.h>
#include <pcl_als/trajectory/trajectory_errors.h>

namespace pcl_als {

/** \brief Effect of known biases on many points (Habib et al. 2011, Eq. (13)), and its inverse,
 * with no trigonometry per point.
 *
 * Equal to point - corrected(pose, point, biases) for every point, in which Eq. (8) is not
 * linearised; beta, needed for a scan angle scale only, is computed by a polynomial with an error
 * under 1e-10 rad. Points in order of time share the interpolation of the trajectory and are
 * computed by vector instructions; other orders give the same results more slowly.
 *
 * Const member functions may be called from several threads.
 */
class BiasEvaluator {
 public:
  /// \a biases: assumed - true, m, rad, 1. UsageError for values that are not finite or implausible
  /// for a mounted scanner: angles of 0.1 rad, a scale of 0.1, lengths of 100 m and more. \a
  /// errors: of the trajectory itself, removed together with the biases (strip corrections); null:
  /// none.
  BiasEvaluator(std::shared_ptr<const Trajectory> trajectory, const SystemVector& biases,
                std::shared_ptr<const TrajectoryErrors> errors = nullptr);

  const Trajectory& trajectory() const { return *trajectory_; }
  const SystemVector& biases() const { return biases_; }

  /// corrected = point - effect, Eq. (13). Input and output columns of an
  /// axis may be the same.
  void effect(const PointColumns& points, std::size_t count, const EffectColumns& effect,
              CoverageCount& coverage) const;

  /// For corrected points: the effect for which effect() at point + effect is the same. By
  /// fixed-point iteration until it changes by less than 1e-7 m.
  void inverseEffect(const PointColumns& points, std::size_t count, const EffectColumns& effect,
                     CoverageCount& coverage) const;

 private:
  void countMissed(double time, CoverageCount& coverage) const;
  void spanEffect(const FlightSpan& span, const PointColumns& points, std::size_t count,
                  const EffectColumns& effect, CoverageCount& coverage) const;

  std::shared_ptr<const Trajectory> trajectory_;
  SystemVector biases_;
  std::shared_ptr<const TrajectoryErrors> errors_;
};

}  // namespace pcl_als
