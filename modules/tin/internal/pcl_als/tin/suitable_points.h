// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Core>

#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als {

/// Division of the work of suitablePoints(): TINs of squares with margins, as in the calibration.
struct SuitablePointsSettings {
  double area_size = 50.0;    ///< metres, > 0
  double margin = 8.0;        ///< metres around a square, >= 0: more than three neighbourhoods
  double resolution = 0.001;  ///< metres, coordinate step
  /// Limit of the roughness as a multiple of the median of suitable patches with slopes up to 15
  /// degrees, in addition to SurfaceCriterion::roughness; 0: no such limit.
  double plain_roughness_factor = 3.0;
  int threads = 0;  ///< 0: all cores; the result does not depend on it

  void check() const;  ///< UsageError
};

/** \brief Which points of one strip lie on a surface that is suitable for measurement.
 *
 * A point is judged by the neighbourhood of one of the triangles around it, without the triangle's
 * own vertices, so that its own noise has no influence. Points that coincide in plan with another
 * point are judged with it where it is a vertex of the TIN, and are otherwise not suitable.
 *
 * \param points those that may be part of a surface (last returns, no vegetation, no noise),
 * finite, metres, any frame; squares are counted from its origin \return by point
 */
std::vector<bool> suitablePoints(const std::vector<Eigen::Vector3d>& points,
                                 const SurfaceCriterion& criterion,
                                 const SuitablePointsSettings& settings = {});

}  // namespace pcl_als
