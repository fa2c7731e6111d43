// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/progress.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/processing/strip_positions.h>
#include <pcl_als/registration/patch_alignment.h>

namespace pcl_als {

/// Two strips to align.
struct AlignmentPair {
  StripPart source, target;
  std::vector<ExcludedPoints> excluded;
  bool measured = false;  ///< the boxes are those of points; otherwise those that headers state
};

/// The source and the target are two files. \a choice: the strips of these that are used; without
/// it all points.
AlignmentPair filePair(const std::vector<std::filesystem::path>& files,
                       const std::optional<StripChoice>& choice);
/// The source and the target are two strips of the files. UsageError "WHAT: …" for a word that is
/// no name of a strip, InputError for a number that no strip has.
AlignmentPair namedPair(const std::vector<std::filesystem::path>& files,
                        const std::pair<std::string, std::string>& names, const StripChoice& choice,
                        const std::string& what);

struct PairAlignment {
  PatchAlignmentResult result;
  std::size_t source_points = 0, target_points = 0;  ///< in common reach
};

/// Aligns the source with the target by ICPatch. InputError for strips that do not overlap and for
/// files that cannot be used together.
PairAlignment registerPair(const AlignmentPair& pair, PatchAlignmentSettings settings,
                           const ProgressCallback& progress = {});

/// The reason for which an alignment is not reliable, in one line.
std::string unreliability(const PatchAlignmentResult& result);

}  // namespace pcl_als
