// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/registration/patch_alignment_result.h>

namespace pcl_als {

class AreaOffsets;
struct PatchAlignmentSettings;

/// The rigid motion of strip a onto strip b (ICPatch) over the areas in which both have points;
/// each point is used once, in the area that contains it. Memory: 12 bytes per point, and
/// registerPatches().
PatchAlignmentResult registerStrips(const std::vector<AreaOffsets>& areas, int a, int b,
                                    const PatchAlignmentSettings& settings);

const char* toString(PatchAlignmentResult::Status status);

/// The motion of a pair, for the closure of triangles.
struct PairMotion {
  std::string a, b;
  PatchAlignmentResult result;
};

/// Three strips that were aligned in pairs: the difference of the motions a -> b -> c and a -> c at
/// the middle of the three overlaps, metres. Standard deviations assume independent alignments.
struct MotionClosure {
  std::string a, b, c;
  Eigen::Vector3d closure = Eigen::Vector3d::Zero(), std = Eigen::Vector3d::Zero();
};
/// From the pairs that converged with all six parameters determined.
std::vector<MotionClosure> closeMotions(const std::vector<PairMotion>& pairs);

}  // namespace pcl_als
