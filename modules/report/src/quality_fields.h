// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/fields.h>
#include <pcl_als/quality/control_check.h>
#include <pcl_als/quality/pair_assessment.h>
#include <pcl_als/registration/patch_alignment.h>

namespace pcl_als {

// Parts of quality.json.
const Fields<OffsetSummary>& summaryFields();
const Fields<SlopeAspectClass>& classFields();
const Fields<HorizontalShift>& horizontalFields();
const Fields<PatchAlignmentResult>& alignmentFields();
const Fields<ControlAssessment>& controlFields();

/// An interval with its quantity: "distance_m", "time_s" or "scan_angle_deg".
struct NamedBin {
  const char* over;
  ProfileBin bin;
};
const Fields<NamedBin>& namedBinFields();

/// "QL1"; none where no level is kept.
std::optional<std::string> nameOfLevel(const std::optional<int>& level);

}  // namespace pcl_als
