// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

#include <Eigen/Geometry>

#include <pcl_als/registration/patch_alignment_result.h>
#include <pcl_als/registration/point_view.h>

namespace pcl_als {

/// Settings of PatchAlignment; metres and radians.
struct PatchAlignmentSettings {
  double search_distance = 15.0;  ///< > 0: largest distance of the surfaces at the initial motion
  bool estimate_scale = false;    ///< a seventh unknown
  std::size_t points = 700'000;   ///< triangulated points of each cloud, approximately
  std::size_t pairs = 180'000;    ///< candidates in each direction, approximately
  int maximum_iterations = 50;    ///< of the fine stage
  double convergence = 2e-5;      ///< metres: no point moves further in an iteration
  double determined_std = 0.1;    ///< metres at the overlap's radius: above, not determined
  double resolution = 0.001;      ///< metres, of plan coordinates; see Tin
  int threads = 0;                ///< 0: all cores; the result does not depend on it
  /// Covariance of one point's coordinates, up to a factor (sigma0 is estimated): 3 x 3, ground
  /// frame.
  Eigen::Matrix3d source_noise = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d target_noise = Eigen::Matrix3d::Identity();
};

/** \brief Registers one strip to another: points against TIN patches, modified weights, both
 * directions (Habib et al. 2011, section 2.3; ICPatch). The engine of IterativeClosestPatch, for
 * clouds of any type and in any two local frames.
 *
 * 1. Coarse: the lowest points of successively smaller plan cells, within search_distance.
 * 2. Areas are chosen in the overlap, evenly and by relief, and triangulated in both clouds.
 * 3. Points on smooth surfaces, evenly over slopes and aspects, are paired with the closest patch
 * of the other cloud. A pair is one equation along the normal n of the patches' neighbourhoods,
 *      n'(t + theta x (p - c) + ds (p - c)) = -d,   weight 1 / n'(Sigma_s + Sigma_t) n,
 *    the modified weight of Eqs. (31)-(34) for a scalar: displacements in the plane have no cost.
 * Huber weights, zero beyond 4.5 standard deviations.
 * 4. Directions that the patches do not determine are found from eigenvalues, keep their initial
 * value, and are reported.
 *
 * Exchanging source and target gives the inverse motion. Memory: about 250 bytes for each
 * triangulated point, 16 for each cell of some five points.
 */
PatchAlignmentResult registerPatches(const PointView& source, const PointView& target,
                                     const PatchAlignmentSettings& settings = {},
                                     const Eigen::Affine3d& guess = Eigen::Affine3d::Identity());

}  // namespace pcl_als
