// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

#include <pcl_als/registration/patch_alignment.h>

#include "patch_adjustment.h"
#include "plan_cells.h"

namespace pcl_als::registration {

/// Result of the last adjustment: covariances, determined parameters, fit.
class AlignmentReport {
 public:
  AlignmentReport(const PatchPairs& pairs, const AdjustmentFrame& frame,
                  const ScatterBySlope& scatter, const Directions& directions,
                  const PatchAlignmentSettings& settings)
      : pairs_(pairs),
        frame_(frame),
        scatter_(scatter),
        directions_(directions),
        settings_(settings) {}

  /// Covariance of the unknowns. Of the result surface_std and convergence_std have been set;
  /// deformation_std is set here. \param groups of the jackknife.
  void estimate(const PlanGrid& groups, PatchAlignmentResult& result);
  /// After estimate(): the directions whose standard deviations are larger than the limit.
  HeldDirections undetermined() const;
  /// After estimate(); result.motion has been set before.
  void fill(PatchAlignmentResult& result) const;

 private:
  using Matrix6d = PatchAlignmentResult::Matrix6d;
  void fillParameters(PatchAlignmentResult& result) const;
  void fillCovariance(PatchAlignmentResult& result) const;
  void fillFit(PatchAlignmentResult& result) const;
  /// Covariance of the directions that keep their initial value.
  UnknownsMatrix ofWeakDirections() const;
  /// Covariance of XT … kappa (m, rad) from that of the unknowns.
  Matrix6d ofParameters(const UnknownsMatrix& covariance, const RigidMotion& motion) const;

  const PatchPairs& pairs_;
  AdjustmentFrame frame_;
  ScatterBySlope scatter_;
  Directions directions_;
  const PatchAlignmentSettings& settings_;
  /// Of the determined directions, square metres: as reported, and its parts.
  UnknownsMatrix covariance_ = UnknownsMatrix::Zero(), formal_ = UnknownsMatrix::Zero(),
                 jackknife_ = UnknownsMatrix::Zero(), correlated_ = UnknownsMatrix::Zero();
  std::size_t groups_ = 0;  ///< of the jackknife, with pairs
};

}  // namespace pcl_als::registration
