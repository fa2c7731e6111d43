// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/quality/pair_assessment.h>
#include <pcl_als/registration/patch_alignment.h>

namespace pcl_als {

class AreaOffsets;

/// The rigid motion of strip a onto strip b (ICPatch) over the areas in which both have points;
/// each point is used once, in the area that contains it. Memory: 12 bytes per point, and
/// registerPatches().
PatchAlignmentResult registerStrips(const std::vector<AreaOffsets>& areas, int a, int b,
                                    const PatchAlignmentSettings& settings);

/// The motion of a pair, for the closure of triangles.
struct PairMotion {
  std::string a, b;
  PatchAlignmentResult result;
};

/// From the pairs that converged with all six parameters determined.
std::vector<MotionClosure> closeMotions(const std::vector<PairMotion>& pairs);

}  // namespace pcl_als
