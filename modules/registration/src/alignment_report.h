// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

#include <pcl_als/registration/patch_alignment.h>

#include "patch_adjustment.h"

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

  /// result.motion has been set before. \param groups of the jackknife.
  void fill(std::size_t groups, PatchAlignmentResult& result) const;

 private:
  using Matrix6d = PatchAlignmentResult::Matrix6d;
  void fillParameters(PatchAlignmentResult& result) const;
  void fillCovariance(std::size_t groups, PatchAlignmentResult& result) const;
  void fillDeformation(PatchAlignmentResult& result) const;
  void fillFit(PatchAlignmentResult& result) const;
  /// Covariance of XT … kappa (m, rad) from that of the unknowns.
  Matrix6d ofParameters(const UnknownsMatrix& covariance, const RigidMotion& motion) const;

  const PatchPairs& pairs_;
  AdjustmentFrame frame_;
  ScatterBySlope scatter_;
  Directions directions_;
  const PatchAlignmentSettings& settings_;
};

}  // namespace pcl_als::registration
