// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/registration/transformation_estimation_patch.h>

#include "patch_adjustment.h"

namespace pcl_als {

Eigen::Affine3d patchMotion(const std::vector<PointOnPatch>& points) {
  using namespace registration;
  constexpr std::size_t kFewest = 6;
  constexpr double kUndetermined = 10.0;  // metres
  if (points.size() < kFewest) return Eigen::Affine3d::Identity();
  AdjustmentFrame frame;
  for (const PointOnPatch& p : points) frame.centre += p.point;
  frame.centre /= static_cast<double>(points.size());
  double squares = 0.0;
  for (const PointOnPatch& p : points) squares += (p.point - frame.centre).squaredNorm();
  frame.radius = std::max(std::sqrt(squares / static_cast<double>(points.size())), 1e-6);
  PatchPairs pairs;
  pairs.reserve(points.size());
  for (const PointOnPatch& p : points)
    pairs.push_back({p.normal, p.point, p.signed_normal_distance, 0.0, 1.0, 0.0, 0, true});
  Weighting weighting;
  return frame.motionOf(
      PatchAdjustment(pairs, frame, kWhileMoving, 1).solve(kUndetermined, kNoPrior, weighting));
}

}  // namespace pcl_als
