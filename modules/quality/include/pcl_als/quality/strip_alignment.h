// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/quality/area_offsets.h>
#include <pcl_als/registration/patch_alignment.h>

namespace pcl_als {

/// The rigid motion of strip a onto strip b (ICPatch) over the areas that both have points in; each
/// point counts once, in the area it lies in. Memory: 12 bytes per point, and alignPatches().
PatchAlignmentResult alignStrips(const std::vector<AreaOffsets>& areas, int a, int b,
                                 const PatchAlignmentSettings& settings);

const char* toString(PatchAlignmentResult::Status status);

/// A pair's motion, for closing triangles.
struct PairMotion {
  std::string a, b;
  PatchAlignmentResult result;
};

/// Three strips that were aligned in pairs: what is left of a point that goes a -> b -> c and is
/// compared with a -> c, in the middle of the three overlaps, metres. Standard deviations take the
/// three alignments as independent.
struct MotionClosure {
  std::string a, b, c;
  Eigen::Vector3d closure = Eigen::Vector3d::Zero(), std = Eigen::Vector3d::Zero();
};
/// Of the pairs that converged with all six parameters determined.
std::vector<MotionClosure> closeMotions(const std::vector<PairMotion>& pairs);

}  // namespace pcl_als
