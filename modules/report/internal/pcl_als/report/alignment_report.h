// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pcl_als/common/excluded_points.h>
#include <pcl_als/registration/patch_alignment.h>

namespace pcl_als {

class FieldTable;

/// Source and target of an alignment.
struct AlignedStrips {
  std::string source, target;
  std::uint64_t source_points = 0, target_points = 0;  ///< in the common area
  std::vector<ExcludedPoints> excluded;                ///< points that were excluded
};

/// Table for the terminal: XT, YT, ZT (m), omega, phi, kappa (deg) and the fit of the strips.
std::string alignmentTable(const PatchAlignmentResult& result);

/// The description of the result as JSON.
const FieldTable& icpatchFields();
std::string alignmentJson(const PatchAlignmentResult& result, const AlignedStrips& strips);

}  // namespace pcl_als
