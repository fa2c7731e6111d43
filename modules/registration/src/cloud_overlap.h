// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Geometry>

#include <pcl_als/registration/patch_alignment.h>
#include <pcl_als/registration/point_view.h>

#include "alignment_areas.h"
#include "plan_cells.h"

namespace pcl_als::registration {

/// Where two clouds overlap. Working coordinates are the target's, relative to a reference point.
struct CloudOverlap {
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< metres, ground frame
  CommonCells cells;
  PlanGrid groups;  ///< of the jackknife
  /// of the cells with points of both clouds; working coordinates of the source
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double radius = 1.0;  ///< metres, RMS plan distance from the centroid
  double area = 0.0;    ///< square metres

  /// False where the clouds do not overlap.
  bool find(const PointView& source, const PointView& target,
            const PatchAlignmentSettings& settings, const Eigen::Affine3d& guess);

 private:
  bool readCells(const PointView& source, const PointView& target,
                 const PatchAlignmentSettings& settings, const Eigen::Affine3d& guess);
  bool measure();
};

}  // namespace pcl_als::registration
