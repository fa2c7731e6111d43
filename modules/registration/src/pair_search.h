// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "patch_pair.h"
#include "plan_cells.h"
#include "surface_side.h"

namespace pcl_als::registration {

/// Surfaces of both clouds in one area, each in its own coordinates.
struct AreaSurfaces {
  SurfaceSide source, target;
};

/// Contribution of point covariances to the variances of pairs, in units of sigma0^2.
struct PointNoise {
  Eigen::Matrix3d source = Eigen::Matrix3d::Identity(), target = Eigen::Matrix3d::Identity();
};

/** \brief Forms the pairs of both directions in all areas, with the source moved.
 *
 * \param groups cells whose pairs the jackknife excludes together.
 * \param stride only every stride-th candidate is used. The order of the pairs and their values do
 * not depend on the number of threads.
 */
PatchPairs findPairs(std::vector<AreaSurfaces>& areas, const Eigen::Affine3d& motion,
                     double threshold, const PlanGrid& groups, const PointNoise& noise, int threads,
                     std::size_t stride = 1);

}  // namespace pcl_als::registration
