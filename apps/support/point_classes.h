// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include <pcl_als/classification/land_cover_filter.h>

namespace pcl_als::app {

struct PointClassCounts {
  std::uint64_t points = 0, unclassified = 0;
};

/** \brief A copy of a point file with the ASPRS codes of land cover in its classification.
 *
 * .las and .laz record by record in constant memory, all else byte for byte; .pcd through
 * LandCoverFilter. A point without a class keeps its code. InputError for a code that the file's
 * point format cannot carry.
 */
PointClassCounts classifyPointFile(const std::filesystem::path& input,
                                   const std::filesystem::path& output,
                                   const std::shared_ptr<const PointClassifier>& classifier,
                                   int threads);

}  // namespace pcl_als::app
